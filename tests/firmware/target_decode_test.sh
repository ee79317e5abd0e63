#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: target_decode_test.sh BUILD simulated|recorded|captured: the firmware under QEMU decodes what the host decodes, to
# the tick: every row of tools/target-decode is one of `pharos decode` and the other way round (hits that end in one tick
# have no order on pins, so rows are compared sorted). captured: the Verilated capture block at 50 MHz is between light
# and firmware. 77 = skipped.
set -euo pipefail
build=$1 what=$2
root=$(cd "$(dirname "$0")/../.." && pwd)
pharos=$build/bin/pharos
data=${PHAROS_DATA:-$root/../shared/data}/lighthouse
command -v qemu-system-riscv32 >/dev/null ||
  { echo "skipped: qemu-system-riscv32 is not installed (tools/install-dependencies test)"; exit 77; }
flying=$build/firmware/bin/decoder.qemu_virt.elf # for 12 inputs; recordings have up to 32 (tools/target-decode's own image)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

same() { # NAME EDGES ROWS-AT-LEAST OPTIONS-OF-DECODE...: compares the target's table $work/target.csv with the host's
  local name=$1 edges=$2 least=$3
  shift 3
  "$pharos" decode "$edges" "$@" | sort >"$work/host.csv"
  sort "$work/target.csv" -o "$work/target.csv"
  local rows
  rows=$(wc -l <"$work/host.csv")
  [ "$rows" -ge "$least" ] || { echo "FAILED: $name: only $rows rows to compare"; exit 1; }
  cmp "$work/host.csv" "$work/target.csv" ||
    { diff "$work/host.csv" "$work/target.csv" | head -20; echo "FAILED: $name: host (<) and target (>) differ"; exit 1; }
  echo "$name: $rows rows equal"
}
decode_on_target() { "$root/tools/target-decode" --build "$build" "$@" >"$work/target.csv"; }
slice() { zcat "$data/$1.edges.csv.gz" 2>/dev/null | head -n "$2" >"$work/$1.csv" || true; } # RECORDING LINES

case $what in
  simulated)
    sed '/^duration_s/s/.*/duration_s = 20/' "$root/tools/sim/scenarios/demo.toml" >"$work/restart.toml"
    printf '[[faults.restart]]\nstation = 0\nat_s = 6.0\noff_s = 2.0\n' >>"$work/restart.toml"
    cp "$root/tools/sim/scenarios/target12.csv" "$work"
    for file in "$root"/tools/sim/scenarios/{demo,two_stations}.toml "$work/restart.toml"; do
      scenario=$(basename "$file" .toml)
      "$pharos" sim lighthouse "$file" --seed 5 --output "$work/$scenario" 2>/dev/null
      decode_on_target --image "$flying" "$work/$scenario/edges.csv.gz"
      same "$scenario" "$work/$scenario/edges.csv.gz" 5000
      decode_on_target --image "$flying" "$work/$scenario/edges.csv.gz" --ootx
      same "$scenario, OOTX" "$work/$scenario/edges.csv.gz" 5 --ootx
    done
    ;;
  recorded)
    [ -e "$data/hmd_static.edges.csv.gz" ] || { echo "skipped: no recordings at $data (set PHAROS_DATA)"; exit 77; }
    for recording in hmd_static controller_quick two_bodies_controller; do
      slice $recording 40000
      decode_on_target "$work/$recording.csv"
      same $recording "$work/$recording.csv" 3000
    done
    ;;
  captured)
    player=$build/tests/edges_through_capture
    [ -x "$player" ] || { echo "skipped: verilator is not installed (tools/install-dependencies test)"; exit 77; }
    "$pharos" sim lighthouse "$root/tools/sim/scenarios/demo.toml" --seed 9 --output "$work/demo" 2>/dev/null
    (zcat "$work/demo/edges.csv.gz" || true) | head -n 4000 >"$work/simulated.csv" || true
    captured=(simulated)
    if [ -e "$data/two_bodies_controller.edges.csv.gz" ]; then
      slice two_bodies_controller 20000
      captured+=(two_bodies_controller)
    fi
    for name in "${captured[@]}"; do
      "$player" "$work/$name.csv" --output "$work/records"
      "$(dirname "$0")/tape.py" <"$work/records" >"$work/words"
      decode_on_target --words "$work/words"
      same "$name through the capture block" "$work/$name.csv" 1000
    done
    ;;
esac
