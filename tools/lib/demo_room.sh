# SPDX-License-Identifier: Apache-2.0
# The part of tools/demo with stations of Lighthouse 2.0; it uses that script's functions and its folder $work.
# shellcheck shell=bash disable=SC2154
room_scenario=tools/sim/scenarios/lh2.toml

# A target before two stations of Lighthouse 2.0, whose poses are in the world.
room() {
  say "a target before two stations of Lighthouse 2.0 ($room_scenario), its poses in the world"
  url="udpm://239.255.76.67:$((20000 + RANDOM % 10000))?ttl=0"
  # The room's stations as they announce themselves: a short play of the same seed.
  sed "s/^duration_s.*/duration_s = 0.1/; s#^target = \"#&$PWD/tools/sim/scenarios/#" $room_scenario >"$work/room.toml"
  build/bin/pharos sim lighthouse "$work/room.toml" --seed 1 --output "$work/room" 2>"$work/room.log" || die "no stations of the room: $(cat "$work/room.log")"
  cat >"$work/room_daemon.toml" <<END
source = "demo"
[lcm]
url = "$url"
[publish]
max_age_s = 1.0
[[target]]
name = "room"
port = "$work/room_port"
baud = 12_000_000
target_file = "room/target.csv"
generation = 2
stations_file = "room/stations.toml"
END
  build/bin/pharos sim serial $room_scenario --seed 1 --link "$work/room_port" --truth "$work/room_truth.csv" >/dev/null 2>"$work/target.log" &
  children+=($!)
  wait_for_file "$work/room_port" $! "the target in the room"
  build/bin/pharosd "$work/room_daemon.toml" 2>"$work/room_daemon.log" &
  daemon=$!
  children+=($daemon)
  seconds=6
  hear PHAROS_LIGHTHOUSE_POSE "$work/room_truth.csv" 200 room || { cat "$work/target.log" "$work/room_daemon.log" >&2; die "no pose in the room came"; }
  cat "$work/room.summary"
  kill -TERM $daemon
  wait $daemon || die "pharosd did not stop cleanly"
}
