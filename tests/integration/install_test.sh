#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: install_test.sh BUILD_DIR
# Installs into a folder of its own and checks that everything is there, fits together and runs from there.
set -euo pipefail
build=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "install: $*" >&2; exit 1; }

DESTDIR=$root cmake --install "$build" --prefix /usr >"$root/install.log" || { cat "$root/install.log" >&2; fail "refused"; }
for file in bin/pharosd bin/pharos bin/pharos-example-subscriber lib/systemd/system/pharosd.service \
  lib/udev/rules.d/70-pharos.rules share/doc/pharos/README.md share/doc/pharos/subscribers.md \
  share/doc/pharos/examples/pharosd.toml share/doc/pharos/examples/target12.csv share/doc/pharos/examples/subscriber.cpp \
  libexec/pharos/pharos-camera share/pharos/lcm/pose_t.lcm share/pharos/lcm/status_t.lcm include/pharos_lcm/pharos/pose_t.hpp; do
  [ -s "$root/usr/$file" ] || fail "/usr/$file is missing or empty"
done
[ ! -e "$root/etc" ] || fail "an installation must not touch /etc"

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
if grep -q '@' <(grep -v '^#' "$unit" | grep -v SystemCallFilter); then fail "the unit has names that were not filled in"; fi
if command -v systemd-analyze >/dev/null; then
  sed "s|ExecStart=/usr/bin|ExecStart=$root/usr/bin|; /^Documentation=/d" "$unit" >"$root/pharosd.service"
  words=$(systemd-analyze verify --man=no "$root/pharosd.service" 2>&1) || fail "systemd-analyze: $words"
  [ -z "$words" ] || fail "systemd-analyze: $words"
fi

# The example subscriber can be built from what was installed alone.
"${CXX:-c++}" -std=c++17 -fsyntax-only -I"$root/usr/include/pharos_lcm" "$root/usr/share/doc/pharos/examples/subscriber.cpp" ||
  fail "the example subscriber does not compile against the installed types"
