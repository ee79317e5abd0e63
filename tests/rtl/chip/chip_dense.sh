#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: chip_dense.sh BUILD: the densest light, twelve sensors all hit by both stations in every sweep (8,650 edges a second), on the
# simulated chip: sweeps equal to the host's, and no more of the core than was asked. Prints the figures of firmware/rtl/soc/README.md.
# 77 = skipped.
set -euo pipefail
build=$1
root=$(cd "$(dirname "$0")/../../.." && pwd)
program=$build/firmware/bin/decoder.ep4ce10.bin
[ -r "$program" ] || { echo "skipped: the images are not built (target firmware)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Without normals no sensor is ever turned away.
sed 's/^duration_s = .*/duration_s = 4.0/' "$root/tools/sim/scenarios/two_stations.toml" >"$work/dense.toml"
cut -d, -f1-4 "$root/tools/sim/scenarios/target12.csv" >"$work/target12.csv"
"$build/bin/pharos" sim lighthouse "$work/dense.toml" --seed 1 --output "$work" 2>/dev/null
"$build/tests/chip_simulator" "$work/edges.csv.gz" --program "$program" --output "$work/line" 2>"$work/figures"
cat "$work/figures"
"$build/bin/pharos" decode "$work/edges.csv.gz" | sort >"$work/host.csv"
"$build/bin/pharos" decode "$work/line" | sort >"$work/chip.csv"
[ "$(wc -l <"$work/host.csv")" -ge 5000 ] || { echo "FAILED: too few rows to compare"; exit 1; }
cmp "$work/host.csv" "$work/chip.csv" || { echo "FAILED: host and chip differ"; exit 1; }
sed -E 's/.*at most ([0-9]+)\.[0-9] % busy.*/\1/' "$work/figures" | awk '$1 < 1 || $1 >= 15 { exit 1 }' ||
  { echo "FAILED: more than 15 % of the core"; exit 1; }
echo "$(wc -l <"$work/host.csv") rows equal"
