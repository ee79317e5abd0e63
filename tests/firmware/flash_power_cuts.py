#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cuts the power of a target under QEMU (SIGKILL, the flash's file remains) at random times during `pharos flash`, until COUNT of
them were before its end. Every time the target must start a complete image: the previous or the new one. 77 = skipped."""

import argparse
import pathlib
import random
import subprocess
import sys
import tempfile
import time

from qemu_target import DECODER, QemuTarget, have_qemu


def start_flash(pharos, target, image):
    return subprocess.Popen([pharos, "flash", target.port, image, "--allow-older", "--wait", "20"], stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def version_that_runs(target, what):
    hello = target.hello(60)
    if hello is None or hello.role != DECODER or hello.version not in ((1, 0, 1), (1, 0, 2)):
        raise SystemExit(f"FAILED: {what}: {'silence' if hello is None else vars(hello)}")
    return hello.version[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pharos", type=pathlib.Path)
    parser.add_argument("images", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if not have_qemu():
        print("skipped: qemu-system-riscv32 is not installed (tools/install-dependencies test)")
        return 77
    dice = random.Random(arguments.seed)
    kept = taken = cuts = 0
    with tempfile.TemporaryDirectory() as folder, QemuTarget(arguments.images, pathlib.Path(folder) / "flash") as target:
        target.switch_on()
        began = time.monotonic()
        run = start_flash(arguments.pharos, target, arguments.images / "flash_probe_1.image")
        if run.wait(120) != 0:
            raise SystemExit(f"FAILED: the first image: {run.stderr.read()}")
        longest = time.monotonic() - began  # the machine may be slower or quicker later
        runs = version_that_runs(target, "the first image")
        while cuts < arguments.count:
            began = time.monotonic()
            run = start_flash(arguments.pharos, target, arguments.images / f"flash_probe_{3 - runs}.image")
            try:
                run.wait(dice.uniform(0, longest))
                longest = min(longest, time.monotonic() - began)
            except subprocess.TimeoutExpired:
                longest *= 1.01
                cuts += 1
            target.switch_off()
            try:
                code = run.wait(60)
            except subprocess.TimeoutExpired:
                run.kill()
                raise SystemExit(f"FAILED: cut {cuts}: pharos flash hangs when its target is gone")
            messages = run.stderr.read()
            if code not in (0, 1, 2):  # 2: power was cut before the port was opened
                raise SystemExit(f"FAILED: cut {cuts}: pharos flash ended with {code}: {messages}")
            target.switch_on()
            now = version_that_runs(target, f"after cut {cuts} ({messages.strip()})")
            if code == 0 and now == runs:
                raise SystemExit(f"FAILED: cut {cuts}: the image was said to run, and is not there")
            if code == 2 and now != runs:
                raise SystemExit(f"FAILED: cut {cuts}: no port was opened, and another image runs")
            if code != 0:
                kept += now == runs
                taken += now != runs
            runs = now
    print(f"{cuts} power cuts, seed {arguments.seed}: {kept} times the old image, {taken} times the new one, never another")
    return 0


if __name__ == "__main__":
    sys.exit(main())
