#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: chip_daemon.py BUILD [SECONDS]: the whole chain with the programs that users run. `pharos flash` writes `decoder` into the simulated
chip over a pseudo-terminal, its loader verifies and starts it, light of one station falls on its photodiodes, and pharosd reads the port:
what it records are the host's sweeps of that light, to the tick, and what it publishes on LCM are the host's poses. 77 = skipped.
`pharos flash` runs in the chip's time (chip_clock_preload.cpp), pharosd in its own: the simulation may be as slow as it likes."""

import contextlib
import csv
import io
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENARIOS = ROOT / "tools" / "sim" / "scenarios"
START_S = 0.4  # until pharosd has related both clocks there are no poses
SAME_M = 1e-6


def light_of(pharos, seconds, folder):
    scenario = (SCENARIOS / "demo.toml").read_text()
    scenario = re.sub(r"(?m)^duration_s = .*", f"duration_s = {seconds}", scenario).replace('"target12.csv"', f'"{SCENARIOS}/target12.csv"')
    (folder / "light.toml").write_text(scenario)
    subprocess.run([pharos, "sim", "lighthouse", folder / "light.toml", "--seed", "5", "--output", folder / "light"], check=True,
                   stderr=subprocess.DEVNULL)
    return folder / "light" / "edges.csv.gz"


def configuration(folder, url):
    (folder / "pharosd.toml").write_text(
        f'[lcm]\nurl = "{url}"\n[publish]\nmax_age_s = 1.0\nbearings = false\n[recording]\ndirectory = "{folder}/recordings"\n'
        f'[[target]]\nname = "chip"\nport = "{folder}/port"\ntarget_file = "{SCENARIOS}/target12.csv"\n')
    return folder / "pharosd.toml"


@contextlib.contextmanager
def running(*command, stop=signal.SIGTERM, **streams):
    with subprocess.Popen(command, text=True, **streams) as process:
        try:
            yield process
        finally:
            process.send_signal(stop)


def wait_for(condition, seconds, what):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"{what} did not come within {seconds} s"
        time.sleep(0.05)


def rows_of(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


def positions(table, status):
    rows = csv.DictReader(io.StringIO(table))
    return [tuple(float(row[axis]) for axis in ("tx_m", "ty_m", "tz_m")) for row in rows if row[status] == "ok"]


def flash(build, folder, image):
    in_chip_time = {"LD_PRELOAD": str(build / "tests" / "libchip_clock_preload.so"), "PHAROS_CHIP_CLOCK": str(folder / "clock")}
    done = subprocess.run([build / "bin" / "pharos", "flash", folder / "port", image], check=False, text=True, capture_output=True,
                          env={**os.environ, **in_chip_time})
    assert done.returncode == 0, done.stderr
    print(done.stdout.splitlines()[-1])


def read_by_daemon(build, folder, chip, log):
    """Text of the poses that pharosd published of what the chip sends."""
    url = f"udpm://239.255.76.69:{random.randint(20000, 40000)}?ttl=0"
    heard = folder / "heard.csv"
    with heard.open("w") as out, running(build / "bin" / "pharos", "listen", "--url", url, "--csv", stop=signal.SIGINT, stdout=out,
                                         stderr=subprocess.DEVNULL):
        with running(build / "bin" / "pharosd", configuration(folder, url), stderr=(folder / "daemon.log").open("w")) as daemon:
            wait_for(lambda: "played" in log.read_text() or chip.poll() is not None, 60, "the end of the light")
            time.sleep(1.0)
            daemon.terminate()
            assert daemon.wait(20) == 0, (folder / "daemon.log").read_text()
    return heard.read_text()


def compare(pharos, folder, heard, seconds):
    edges = folder / "moved.csv"
    recording, = (folder / "recordings").rglob("*.phraw*")
    here, there = (sorted(rows_of(pharos, "decode", file).splitlines()[1:]) for file in (edges, recording))
    print(f"{len(here)} rows of the host, {len(there)} of the chip in pharosd's recording")
    assert len(here) > 50 * seconds and here == there, "other sweeps than the host's"
    target = SCENARIOS / "target12.csv"
    wanted = positions(rows_of(pharos, "track", edges, "--target", target), "status")
    published = positions(heard, "status")
    far = [pose for pose in published if min(max(abs(a - b) for a, b in zip(pose, other)) for other in wanted) > SAME_M]
    print(f"{len(published)} poses of pharosd, {len(wanted)} of the host, {len(far)} of them not the host's")
    assert not far and len(published) > (1 - START_S / seconds) * len(wanted) - 5, "other poses than the host's"


def main():
    build, seconds = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2]) if len(sys.argv) > 2 else 2.0
    images, pharos = build / "firmware" / "bin", build / "bin" / "pharos"
    if not (images / "decoder.ep4ce10.image").exists():
        print("skipped: the images are not built (target firmware)")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        edges, log = light_of(pharos, seconds, folder), folder / "chip.log"
        command = [build / "tests" / "chip_terminal", edges, "--loader", images / "ep4ce10_loader.bin", "--verifier", images / "verifier.bin",
                   "--link", folder / "port", "--clock", folder / "clock", "--moved", folder / "moved.csv"]
        with log.open("w") as errors, running(*command, stderr=errors) as chip:
            try:
                wait_for(lambda: (folder / "port").exists(), 10, "the port")
                flash(build, folder, images / "decoder.ep4ce10.image")
                wait_for(lambda: "for a reader" in log.read_text() or chip.poll() is not None, 300, "the light's simulation")
                heard = read_by_daemon(build, folder, chip, log)
            finally:
                print(log.read_text(), end="")
            compare(pharos, folder, heard, seconds)
            assert chip.wait(20) == 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
