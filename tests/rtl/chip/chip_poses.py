#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: chip_poses.py BUILD [SECONDS [boot | FLASH]]: `decoder_pose` on the simulated chip, its code in the SDRAM behind the cache, two stations at full rate:
its sweeps are the host's to the tick; once both stations are calibrated every cycle is answered, by the pose that `pharos track` gives the
same light, to a tenth of a standard deviation, and no sweep is skipped; the model of the SDRAM has no objection. With less
than 10 seconds of light there are no poses yet: the sweeps alone. Starts in the SDRAM; with `boot` from the flash, from which the loader copies it; with FLASH from that content of the flash,
as chip_flash leaves it. Prints the figures of firmware/rtl/soc/README.md. 77 = skipped."""

import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "firmware"))
import poses_test  # noqa: E402
import tape  # noqa: E402

START_TICKS = poses_test.START_TICKS
CALIBRATED_S = 10.0
SOLVING_S = 9.8  # of light, for the counts
BOOT_TICKS = 150_000_000  # before the light: the loader copies and hashes 236 kB


def light_of(pharos, seconds, folder):
    scenarios = ROOT / "tools" / "sim" / "scenarios"
    shutil.copy(scenarios / "target12.csv", folder)
    scenario = folder / "two_stations.toml"
    scenario.write_text(re.sub(r"(?m)^duration_s = .*", f"duration_s = {seconds}", (scenarios / scenario.name).read_text()))
    subprocess.run([pharos, "sim", "lighthouse", scenario, "--seed", "5", "--output", folder / "out"], check=True, stderr=subprocess.DEVNULL)
    return folder / "out"


def later(edges, folder):
    """The same edges with time for the loader before them."""
    moved = folder / "later.csv"
    with gzip.open(edges, "rt") as lines, moved.open("w") as out:
        out.write(next(lines))
        for line in lines:
            sensor, rise, fall = map(int, line.split(","))
            out.write(f"{sensor},{rise + BOOT_TICKS},{fall + BOOT_TICKS}\n")
    return moved


def rows(pharos, file):
    done = subprocess.run([pharos, "decode", file], check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return sorted(done.stdout.splitlines()[1:])


def check_poses(pharos, edges, table, line):
    frames = tape.frames_of(line.read_bytes())
    target, host = dict(poses_test.target_rows(frames)), dict(poses_test.host_rows(pharos, edges, table))
    device = tape.device_counters(frames)
    begin, end = min(time for _, time in target) + START_TICKS, max(time for _, time in target)
    wanted = [key for key, row in host.items() if begin <= key[1] < end and row["status"] == "ok"]
    answered = [key for key in wanted if key in target]
    compared = [poses_test.sigmas(host[key], target[key][1]) for key in answered if target[key][1] and not target[key][0] & poses_test.UNCALIBRATED]
    last = [second for second in device if second["time"] >= begin]
    skipped = device[-1]["poses_skipped"] - min(second["poses_skipped"] for second in device if second["time"] >= begin - START_TICKS)
    print(f"{len(answered)} of {len(wanted)} cycles answered in {(end - begin) / 50e6:.2f} s, {skipped} sweeps skipped, busy "
          f"{max(second['busy_permille'] for second in last) / 10} % at most, {device[-1]['stack_free_bytes']} bytes of stack never used; "
          f"{len(compared)} poses compared, the farthest {max(compared, default=99):.4f} sigma away")
    assert len(wanted) > 40 and len(answered) == len(wanted) and skipped == 0, "the core does not keep up"
    assert len(compared) > 40 and max(compared) <= poses_test.MOST_SIGMAS, "other poses than the host's"


def main():
    build, seconds = pathlib.Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 11.5
    images = build / "firmware" / "bin"
    program = ["--external", images / "decoder_pose.ep4ce10.bin"]
    if boots := len(sys.argv) > 3:
        start = ["--image", images / "decoder_pose.ep4ce10.image"] if sys.argv[3] == "boot" else ["--flash", pathlib.Path(sys.argv[3])]
        program = [*start, "--loader", images / "ep4ce10_loader.bin"]
    if not program[1].exists():
        print("skipped: the images are not built (target firmware)")
        return 77
    pharos = build / "bin" / "pharos"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        light, line = light_of(pharos, seconds, folder), folder / "line"
        edges = later(light / "edges.csv.gz", folder) if boots else light / "edges.csv.gz"
        count_from = ["--count-from", str(SOLVING_S)] if seconds > SOLVING_S else []
        subprocess.run([build / "tests" / "chip_simulator", edges, *program, "--output", line, *count_from], check=True)
        here, there = rows(pharos, edges), rows(pharos, line)
        print(f"{len(here)} rows of the host, {len(there)} of the chip")
        assert len(here) > 100 * seconds and here == there, "host and chip differ"
        if seconds > CALIBRATED_S:
            check_poses(pharos, edges, light / "target.csv", line)
    return 0


if __name__ == "__main__":
    sys.exit(main())
