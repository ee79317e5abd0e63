#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: chip_decodes.sh BUILD PULSES [PHAROS]: the decoder's image on the simulated chip decodes what the host decodes, to the tick, from the
# first PULSES of twelve sensors of a recording; of a simulation where there is no recording. Starts from RAM; with `boot` as a
# fourth argument, from the flash by the loader. 77 = skipped.
set -euo pipefail
build=$1 pulses=$2 pharos=${3:-$1/bin/pharos} start=${4:-ram}
root=$(cd "$(dirname "$0")/../../.." && pwd)
recording=${PHAROS_DATA:-$root/../shared/data}/lighthouse/hmd_static.edges.csv.gz
images=$build/firmware/bin
[ -r "$images/decoder.ep4ce10.bin" ] || { echo "skipped: the images are not built (target firmware)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ -e "$recording" ]; then
  cp "$recording" "$work/all.csv.gz"
else
  "$pharos" sim lighthouse "$root/tools/sim/scenarios/demo.toml" --seed 5 --output "$work" 2>/dev/null
  mv "$work/edges.csv.gz" "$work/all.csv.gz"
fi
# Past the first two seconds, so that the counter is positive when the chip starts.
zcat "$work/all.csv.gz" | awk -F, 'NR == 1 || ($1 < 12 && $2 > 100000000)' >"$work/later.csv"
{ head -1 "$work/later.csv"; tail -n +2 "$work/later.csv" | sort -t, -k2n | awk -v n="$pulses" 'NR <= n'; } >"$work/edges.csv"
if [ "$start" = boot ]; then
  options=(--image "$images/decoder.ep4ce10.image" --loader "$images/ep4ce10_loader.bin")
else
  options=(--program "$images/decoder.ep4ce10.bin")
fi
"$build/tests/chip_simulator" "$work/edges.csv" "${options[@]}" --output "$work/line"
"$pharos" decode "$work/edges.csv" | sort >"$work/host.csv"
"$pharos" decode "$work/line" | sort >"$work/chip.csv"
rows=$(wc -l <"$work/host.csv")
[ "$rows" -ge $((pulses / 40)) ] || { echo "FAILED: only $rows rows to compare"; exit 1; }
cmp "$work/host.csv" "$work/chip.csv" ||
  { diff "$work/host.csv" "$work/chip.csv" | head -20; echo "FAILED: host (<) and chip (>) differ"; exit 1; }
echo "$rows rows equal"
