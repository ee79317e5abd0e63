#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: chip_up5k.sh BUILD [SECONDS [boot]]: the decoder's image on the simulated chip of the iCE40UP5K, core at 16 MHz and capture at 48: four
# sensors, hit by both stations in every sweep. It decodes what the host decodes of the same stamps, to the tick; and against the light
# itself no angle is off by more than the stamps are. Starts from RAM; with `boot`
# from the flash by the loader. Prints the figures of firmware/rtl/up5k/README.md. 77 = skipped.
set -euo pipefail
build=$1 seconds=${2:-4.0} start=${3:-ram}
root=$(cd "$(dirname "$0")/../../.." && pwd)
images=$build/firmware/bin
options=(--program "$images/decoder.up5k.bin")
[ "$start" = ram ] || options=(--image "$images/decoder.up5k.image" --loader "$images/up5k_loader.bin")
[ -r "$images/decoder.up5k.image" ] || { echo "skipped: the images are not built (target firmware)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed "s/^duration_s = .*/duration_s = $seconds/" "$root/tools/sim/scenarios/two_stations.toml" >"$work/four.toml"
head -5 "$root/tools/sim/scenarios/target12.csv" | cut -d, -f1-4 >"$work/target12.csv"
"$build/bin/pharos" sim lighthouse "$work/four.toml" --seed 1 --output "$work" 2>/dev/null
"$build/tests/chip_simulator" "$work/edges.csv.gz" --chip up5k "${options[@]}" --output "$work/line" --stamped "$work/stamped.csv" \
  2>"$work/figures"
cat "$work/figures"
"$build/bin/pharos" decode "$work/stamped.csv" | sort >"$work/host.csv"
"$build/bin/pharos" decode "$work/line" | sort >"$work/chip.csv"
[ "$(wc -l <"$work/host.csv")" -ge "$(awk -v s="$seconds" 'BEGIN { print int(300 * s) }')" ] || { echo "FAILED: too few rows to compare"; exit 1; }
cmp "$work/host.csv" "$work/chip.csv" || { echo "FAILED: host and chip differ"; exit 1; }
echo "$(wc -l <"$work/chip.csv") rows equal"
# Angles of the light itself, by station, axis, sensor and nearest time. A tick is 7.54e-6 rad.
"$build/bin/pharos" decode "$work/edges.csv.gz" >"$work/light.csv"
python3 - "$work/light.csv" "$work/chip.csv" <<'PY'
import csv
import sys

FIELDS = ("time_s", "station", "station_id", "axis", "sensor", "theta_rad")


def rows(path):
    table = {}
    with open(path) as file:
        lines = [line for line in file if line.strip()]
    head = next(line for line in lines if line.startswith("time_s")).strip().split(",")
    for row in csv.DictReader((line for line in lines if not line.startswith("time_s")), fieldnames=head):
        table.setdefault((row["station"], row["axis"], row["sensor"]), []).append((float(row["time_s"]), float(row["theta_rad"])))
    return table


light, chip = map(rows, sys.argv[1:])
differences = []
for key, hits in chip.items():
    for time, theta in hits:
        near, wanted = min(light.get(key, [(1e9, 0.0)]), key=lambda hit: abs(hit[0] - time))
        if abs(near - time) < 1e-4:
            differences.append(theta - wanted)
rms = (sum(d * d for d in differences) / len(differences)) ** 0.5
arcsec = 180 / 3.141592653589793 * 3600
print(f"{len(differences)} angles against the light: {rms * arcsec:.2f} arcsec RMS, {max(map(abs, differences)) * arcsec:.2f} at most")
sys.exit(0 if len(differences) > 100 and max(map(abs, differences)) < 4 * 7.54e-6 and rms < 7.54e-6 else 1)
PY
