#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants one fault at a time in a copy of some logic; the test bench must fail on every one of them, and only then.

A mutant that lives means that the bench has a hole. `--few` takes those that stand for the bench's main promises, `--part 2/4` every
fourth from the second on, `--from NAME` that one and those after it: a run that was cut short goes on there.
"""

import argparse
import functools
import importlib
import pathlib
import resource
import shlex
import subprocess
import sys

PREFIX = "Vmutant"
BENCH_CPU_S = 60  # of the processor: on a busy machine a bench takes long that would end; a sound one takes a second


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(map(str, command))}\n{done.stdout}{done.stderr}")


class Workshop:
    def __init__(self, arguments):
        self.verilator = arguments.verilator
        self.root = arguments.root
        self.top = arguments.top
        self.sources = sorted(self.root.glob(arguments.sources if "*" in arguments.sources else f"{arguments.sources}/*.v"))
        self.device = self.root / arguments.device
        self.folder = arguments.build
        self.folder.mkdir(parents=True, exist_ok=True)
        self.parameters = [f"-G{parameter}" for parameter in arguments.parameter]
        self.compile = [arguments.compiler, "-std=c++20", "-O0", "-w", f"-I{self.root}", f"-I{self.root}/tests",
          f"-isystem{arguments.include}", f"-isystem{arguments.include}/vltstd"]
        self.bench = arguments.bench

    def bench_on(self, name, file, original, replacement):
        """Exit code of the test bench on the logic with `original` in `file` replaced."""
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        for verilog in self.sources:
            text = verilog.read_text()
            if verilog.name == file:
                if text.count(original) != 1:
                    sys.exit(f"{name}: {file} has '{original}' {text.count(original)} times instead of once")
                text = text.replace(original, replacement)
            (folder / verilog.name).write_text(text)
        run([self.verilator, "--cc", "--Mdir", folder, "--prefix", PREFIX, "--top-module", self.top, "-Wno-lint",
          "--output-split", "0", *self.parameters, *(folder / verilog.name for verilog in self.sources)])
        device = folder / "device.cpp"
        device.write_text(self.device.read_text().replace("@prefix@", PREFIX))
        together = folder / "together.cpp"  # one compilation: the headers take longer than the code
        together.write_text("".join(f'#include "{file.name}"\n' for file in (*sorted(folder.glob(PREFIX + "*.cpp")), device)))
        program = folder / "bench"
        run([*self.compile, f"-I{folder}", together, *self.bench, "-o", program, "-lgtest", "-lgtest_main", "-lpthread"])
        command = [program, "--gtest_fail_fast", "--gtest_brief=1"]
        limit = functools.partial(resource.setrlimit, resource.RLIMIT_CPU, (BENCH_CPU_S, BENCH_CPU_S))
        return subprocess.run(command, capture_output=True, check=False, preexec_fn=limit).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--verilator", "--compiler", "--include"):
        parser.add_argument(name, required=True)
    for name in ("--build", "--root"):
        parser.add_argument(name, required=True, type=pathlib.Path)
    parser.add_argument("--parameter", action="append", default=[], help="NAME=VALUE of the Verilog")
    parser.add_argument("--top", default="pharos_capture", help="the logic's module")
    parser.add_argument("--sources", default="firmware/rtl", help="its folder, or the pattern of its files")
    parser.add_argument("--device", default="tests/rtl/verilated_device.cpp.in", help="the bench's view of it")
    parser.add_argument("--mutations", default="mutations", help="the module with the faults")
    parser.add_argument("--few", action="store_true")
    parser.add_argument("--part", default="1/1", metavar="I/N")
    parser.add_argument("--from", dest="first", metavar="NAME")
    parser.add_argument("bench", nargs="+", help="objects and libraries of the bench, built for these parameters")
    arguments = parser.parse_args()
    arguments.build = arguments.build / ("few" if arguments.few else "all")
    faults = importlib.import_module(arguments.mutations)
    listed = [mutation for mutation in faults.MUTATIONS if not arguments.few or mutation[0] in faults.FEW]
    names = [mutation[0] for mutation in listed]
    if arguments.first and arguments.first not in names:
        parser.error(f"no mutant is named {arguments.first}")
    part, parts = map(int, arguments.part.split("/"))
    chosen = listed[names.index(arguments.first) if arguments.first else 0 :][part - 1 :: parts]
    workshop = Workshop(arguments)

    if workshop.bench_on("unharmed", "", "", "") != 0:
        sys.exit("the bench fails on the logic as it is")
    alive = []
    for name, *mutation in chosen:
        killed = workshop.bench_on(name, *mutation) != 0
        print(f"{'killed' if killed else 'ALIVE '} {name}", flush=True)
        alive += [] if killed else [name]
    print(f"{len(chosen) - len(alive)} of {len(chosen)} mutants killed")
    return 1 if alive else 0


if __name__ == "__main__":
    sys.exit(main())
