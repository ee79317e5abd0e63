#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: install_test.sh BUILD_DIR
# Installs into a folder of its own and checks that everything is there, fits together and runs from there.
set -euo pipefail
build=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "install: $*" >&2; exit 1; }

# A partial build, as tools/demo leaves it: what is missing is built.
rm -f "$build/bin/pharos-example-subscriber"
DESTDIR=$root cmake --install "$build" --prefix /usr >"$root/install.log" || { cat "$root/install.log" >&2; fail "refused"; }
for file in bin/pharosd bin/pharos bin/pharos-example-subscriber lib/systemd/system/pharosd.service \
  lib/udev/rules.d/70-pharos.rules share/doc/pharos/README.md share/doc/pharos/subscribers.md \
  share/doc/pharos/examples/pharosd.toml share/doc/pharos/examples/target12.csv share/doc/pharos/examples/subscriber.cpp \
  libexec/pharos/pharos-camera share/pharos/lcm/pose_t.lcm share/pharos/lcm/status_t.lcm include/pharos_lcm/pharos/pose_t.hpp \
  include/pharos/pose/solve.hpp lib/libpharos.a lib/cmake/Pharos/PharosConfig.cmake lib/pkgconfig/pharos.pc \
  share/pharos/scenarios/demo.toml share/pharos/examples/demo.toml share/doc/pharos/OPERATOR.md lib/sysusers.d/pharos.conf lib/tmpfiles.d/pharos.conf \
  share/man/man1/pharos-track.1 share/man/man5/pharosd.toml.5 share/man/man7/pharos-lcm.7 share/man/man8/pharosd.8 \
  share/bash-completion/completions/pharos share/zsh/site-functions/_pharos lib/python3/dist-packages/pharos/pose_t.py; do
  [ -s "$root/usr/$file" ] || fail "/usr/$file is missing or empty"
done
# README edits and the unit reads the same configuration; a configuration in use is kept.
"$root/usr/bin/pharosd" --check "$root/etc/pharos/pharosd.toml" | grep -q 'target target12' || fail "/etc/pharos/pharosd.toml is refused"
echo '# edited' >>"$root/etc/pharos/pharosd.toml"
DESTDIR=$root cmake --install "$build" --prefix /usr >"$root/install.log" || fail "refused the second time"
tail -1 "$root/etc/pharos/pharosd.toml" | grep -q '^# edited$' || fail "the second installation overwrote the configuration"
DESTDIR=$root/local cmake --install "$build" >"$root/install.log" || fail "refused with the default prefix"
grep -q '^ExecStart=/usr/local/bin/pharosd /etc/pharos/pharosd.toml$' "$root/local/usr/local/lib/systemd/system/pharosd.service" ||
  fail "the unit of the default prefix starts something else"
[ -s "$root/local/etc/pharos/pharosd.toml" ] || fail "the default prefix has no configuration in /etc/pharos"
DESTDIR=$root cmake --install "$build" --prefix /usr >"$root/install.log" # the unit of this prefix again

# The example configuration is valid where it lies.
"$root/usr/bin/pharosd" --check "$root/usr/share/doc/pharos/examples/pharosd.toml" | grep -q 'target target12' ||
  fail "the example configuration is refused"
"$root/usr/bin/pharosd" --version >/dev/null || fail "pharosd does not start"

# What pharosd starts for a camera is where it looks for it, beside its own folder; what cameras send is parsed there alone.
"$root/usr/bin/../libexec/pharos/pharos-camera" --version >/dev/null || fail "pharos-camera does not start"
if ldd "$root/usr/bin/pharosd" | grep -q aravis; then fail "pharosd links Aravis"; fi
# What ximgproc brings must not burden every command.
if ldd "$root/usr/bin/pharos" | grep -Eq 'imgcodecs|gdal'; then fail "pharos links OpenCV's imgcodecs"; fi

# The unit names the installed program and, where systemd is there to say so, is sound.
unit=$root/usr/lib/systemd/system/pharosd.service
grep -q '^ExecStart=/usr/bin/pharosd /etc/pharos/pharosd.toml$' "$unit" || fail "the unit starts something else"
if grep -q '@[A-Z_]*@' "$unit"; then fail "the unit has names that were not filled in"; fi
if command -v systemd-analyze >/dev/null; then
  sed "s|ExecStart=/usr/bin|ExecStart=$root/usr/bin|; /^Documentation=/d" "$unit" >"$root/pharosd.service"
  words=$(systemd-analyze verify --man=no "$root/pharosd.service" 2>&1) || fail "systemd-analyze: $words"
  [ -z "$words" ] || fail "systemd-analyze: $words"
  systemd-analyze security --offline=true --threshold=15 "$root/pharosd.service" >"$root/security.log" ||
    fail "the unit's exposure is above 1.5: $(tail -1 "$root/security.log")"
fi
if command -v systemd-sysusers >/dev/null; then
  words=$(systemd-sysusers --dry-run "$root/usr/lib/sysusers.d/pharos.conf" 2>&1) || fail "systemd-sysusers: $words"
fi
if command -v apparmor_parser >/dev/null; then
  apparmor_parser -QK "$root/usr/share/pharos/apparmor/pharosd" || fail "the AppArmor profile is refused"
fi
if grep -q '@PHAROS' "$root/usr/share/pharos/apparmor/pharosd"; then fail "the AppArmor profile has names that were not filled in"; fi

# Position independent, everything resolved and read-only before main; with guards.
for program in bin/pharosd bin/pharos libexec/pharos/pharos-camera; do
  elf=$(readelf -hlWd -s "$root/usr/$program")
  has() { grep -Eq "$1" <<<"$elf"; }
  has 'Type: *DYN' || fail "$program is not position independent"
  has 'GNU_RELRO' || fail "$program has no RELRO"
  has 'FLAGS.*NOW' || fail "$program does not resolve every symbol at its start"
  ! has 'GNU_STACK.*RWE' || fail "$program has an executable stack"
  if grep -q '^CMAKE_BUILD_TYPE:[A-Z]*=Release$' "$build/CMakeCache.txt"; then
    has '__stack_chk_fail' || fail "$program has no stack protector"
    has '_chk@' || fail "$program is not fortified"
  fi
done

# The installed bench finds its peer.
"$root/usr/bin/pharos" bench --help >/dev/null || fail "pharos bench does not start"
[ -s "$root/usr/lib/pharos/libpharos_bench_edge_drawing.so" ] || fail "pharos bench has no EdgeDrawing beside it"

# The example subscriber can be built from what was installed alone.
"${CXX:-c++}" -std=c++17 -fsyntax-only -I"$root/usr/include/pharos_lcm" "$root/usr/share/doc/pharos/examples/subscriber.cpp" ||
  fail "the example subscriber does not compile against the installed types"
