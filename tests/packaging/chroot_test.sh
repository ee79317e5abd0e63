#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: chroot_test.sh PACKAGES_DIR
# Installs the packages in a clean Debian 12, runs Pharos there from installed files alone, builds programs against them,
# and purges them: nothing may be left. PHAROS_DEBIAN_MIRROR: where Debian comes from (http://deb.debian.org/debian).
# Ends with 77, and says so, where that is not possible: not root, no debootstrap, no mirror.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
packages=$(realpath "$1")
mirror=${PHAROS_DEBIAN_MIRROR:-http://deb.debian.org/debian}
skip() { echo "SKIPPED: packages were NOT installed in a clean chroot: $*"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "only root can make one"
command -v debootstrap >/dev/null || skip "debootstrap is not installed (tools/install-dependencies full)"
"${PYTHON:-/usr/bin/python3}" -c 'import sys, urllib.request; urllib.request.urlopen(sys.argv[1], timeout=30)' \
  "$mirror/dists/bookworm/Release" 2>/dev/null || skip "$mirror is not reachable (PHAROS_DEBIAN_MIRROR)"
compgen -G "$packages/pharos_*.deb" >/dev/null || { echo "no packages in $packages: tools/package"; exit 1; }

root=$(mktemp -d -t pharos-chroot-XXXXXX)
children=()
clean_up() {
  for child in "${children[@]}"; do kill "$child" 2>/dev/null || true; done
  wait 2>/dev/null || true
  for place in dev/pts dev proc; do mountpoint -q "$root/$place" && umount -l "$root/$place"; done
  rm -rf --one-file-system "$root"
}
trap clean_up EXIT
fail() { echo "chroot: $*" >&2; exit 1; }
say() { echo "== $*"; }
in_chroot=(chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 HOME=/root
  DEBIAN_FRONTEND=noninteractive)
inside() { "${in_chroot[@]}" "$@"; }
quietly() { "$@" >"$root/log" 2>&1 || { tail -40 "$root/log" >&2; fail "$* failed"; }; }
given() { (cd "$root" && for name; do compgen -G "given/${name}_*.deb" | sed 's|^|/|'; done); }
install_packages() { quietly inside apt-get install -y -qq --no-install-recommends "$@"; }

say "debootstrap"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$packages/debootstrap.log" 2>&1 ||
  { tail -20 "$packages/debootstrap.log" >&2; skip "debootstrap failed"; }
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts"
cp /etc/resolv.conf "$root/etc/resolv.conf"
quietly inside apt-get update -qq
mkdir "$root/given"
cp "$packages"/*.deb "$root/given/"

say "installation"
began=$SECONDS
mapfile -t wanted < <(given pharos pharos-firmware python3-pharos)
install_packages "${wanted[@]}"
installation_s=$((SECONDS - began))
inside getent passwd pharosd >/dev/null || fail "the user pharosd was not made"
inside dpkg-query --show --showformat='${Conffiles}' pharos | grep -q /etc/pharos/pharosd.toml ||
  fail "the configuration is no conffile"
[ "$(stat -c %a "$root/var/spool/pharos" 2>/dev/null || echo none)" != none ] ||
  inside command -v systemd-tmpfiles >/dev/null 2>&1 || echo "no systemd-tmpfiles there: /var/spool/pharos comes at boot"
inside pharosd --check /etc/pharos/pharosd.toml | grep -q 'target target12' || fail "/etc/pharos/pharosd.toml is refused"
for file in decoder.ep4ce10.image ep4ce10_loader.elf verifier.bin; do
  [ -s "$root/usr/share/pharos/firmware/$file" ] || fail "no $file for the board"
done

say "a recording to poses, read by Python"
examples=/usr/share/pharos/examples/lighthouse
inside pharos track $examples/edges.csv.gz --target $examples/target.csv --output /given/poses.csv || fail "pharos track"
inside python3 -c '
import numpy, pharos
table = pharos.read_table("/given/poses.csv")
truth = pharos.read_table("'$examples/truth.csv'")
rotation, position_m = pharos.pose_arrays(table)
off_mm = 1e3 * numpy.abs(numpy.nanmean(position_m, axis=0) - [truth[name].mean() for name in ("tx_m", "ty_m", "tz_m")]).max()
print(len(table["time_s"]), "poses, their mean off by", round(off_mm, 2), "mm")
assert (table["status"] == "ok").mean() > 0.9 and off_mm < 5.0' || fail "the poses are wrong"

say "pharosd before a simulated target, pharos listen against its truth"
port=$((20000 + RANDOM % 10000)) # not that of other daemons on this computer
url=udpm://239.255.76.67:$port?ttl=0
{ cat "$root/usr/share/pharos/examples/demo.toml"; echo "[lcm]"; echo "url = \"$url\""; } |
  sed 's|^max_age_s = .*|max_age_s = 5.0|' >"$root/usr/share/pharos/examples/of_this_test.toml"
began=$SECONDS
"${in_chroot[@]}" pharos sim serial /usr/share/pharos/scenarios/demo.toml --seed 1 --link /tmp/pharos-demo-target \
  --truth /tmp/pharos-demo-truth.csv 2>"$root/given/sim.log" &
children+=($!)
for _ in $(seq 100); do [ -L "$root/tmp/pharos-demo-target" ] && break; sleep 0.1; done
"${in_chroot[@]}" pharosd /usr/share/pharos/examples/of_this_test.toml 2>"$root/given/pharosd.log" &
daemon=$!
children+=($daemon)
"${in_chroot[@]}" pharos view --port 0 --url "$url" >"$root/given/view.txt" 2>"$root/given/view.log" &
children+=($!)
for _ in $(seq 100); do [ -s "$root/given/view.txt" ] && break; sleep 0.1; done
# The page's states, as a browser receives them, up to the first with a pose.
"${PYTHON:-/usr/bin/python3}" -c '
import json, sys, urllib.request
for line in urllib.request.urlopen(sys.argv[1] + "states", timeout=120):
    rows = json.loads(line[6:])["rows"] if line.startswith(b"data: ") else []
    if any("p" in row for row in rows):
        sys.exit(0)
sys.exit("the page shows no pose")' "$(cat "$root/given/view.txt")" || fail "no pose on the page"
echo "installation $installation_s s; then a simulated target, pharosd, pharos view: first pose on the page after $((SECONDS - began)) s"
inside pharos listen PHAROS_LIGHTHOUSE_POSE --url "$url" --truth /tmp/pharos-demo-truth.csv --duration 20 \
  >"$root/given/lines.txt" 2>"$root/given/summary.txt" ||
  { cat "$root/given"/*.log "$root/given/summary.txt" >&2; fail "no pose came"; }
cat "$root/given/summary.txt"
grep -q 'error against truth' "$root/given/summary.txt" || fail "nothing was compared with the truth"
kill "$daemon"
wait "$daemon" || fail "pharosd did not stop cleanly"
kill "${children[0]}" "${children[2]}" 2>/dev/null || true # the simulated target, the page
rm "$root/usr/share/pharos/examples/of_this_test.toml"

say "programs built against the packages"
install_packages "$(given libpharos-dev)" g++ cmake ninja-build pkg-config
mkdir -p "$root/given/tests"
cp -r "$here" "$root/given/tests/packaging"
cp "$here/../../SUBSCRIBER.md" "$root/given/"
inside /given/tests/packaging/consumers_test.sh --installed /usr/bin/python3 || fail "programs outside do not build or run"

say "purge"
quietly inside apt-get purge -y -qq pharos libpharos-dev python3-pharos pharos-firmware
rm -rf "$root/given" "$root/log" "$root"/tmp/pharos-demo-* # of this test
left=$(find "$root" -xdev \( -path "$root/proc" -o -path "$root/dev" -o -path "$root/var/cache/apt" \) -prune -o -name '*pharos*' -print)
[ -z "${left//$root/}" ] || fail "left behind: ${left//$root/}"
# Without /etc/passwd- and the like, in which useradd and userdel keep what was before their last change.
left=$(grep -rl --exclude='*-' pharos "$root/etc" "$root/var/lib/dpkg/info" "$root/var/lib/systemd" 2>/dev/null || true)
[ -z "$left" ] || fail "still named in: ${left//$root/}"
if grep -Eq '^Package: (.*-)?pharos(-.*)?$' "$root/var/lib/dpkg/status"; then fail "dpkg still knows them"; fi
echo "installed, run, built against, purged: nothing left"
