# SPDX-License-Identifier: Apache-2.0
# Sourced by tools/demo and tools/test.
#
# LCM talks by multicast even within one computer, and refuses to start where nothing says where multicast goes.

has_multicast_route() {
  awk 'NR > 1 && (($2 == "00000000" && $8 == "00000000") || ($2 == "000000E0" && $8 == "000000F0")) { found = 1 }
       END { exit !found }' /proc/net/route
}

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi; }

multicast_route_added=no
# Gives multicast a way over the loopback interface where it has none; fails with what to do where it may not.
give_multicast_a_route() {
  has_multicast_route && return
  if as_root ip link set lo up 2>/dev/null && as_root ip route add 224.0.0.0/4 dev lo 2>/dev/null; then
    multicast_route_added=yes
  else
    echo "this computer has no route for multicast, which LCM needs; run: sudo ip route add 224.0.0.0/4 dev lo" >&2
    return 1
  fi
}

take_multicast_route_back() {
  [ "$multicast_route_added" = no ] || as_root ip route del 224.0.0.0/4 dev lo || true
}
