#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cost of compiling a Ninja tree, by part: seconds from start to end of each step, summed, and fractions.

usage: ./build_cost.py BUILD_DIR [--files N]     N: also the N dearest files

Seconds are those of a processor only where nothing else ran and no compiler cache helped; shares bear more.
"""
import argparse
import collections
import pathlib
import re

PARTS = (
    ("common: the portable core", r"common/"),
    ("host and proto", r"(host|proto)/"),
    ("tools", r"tools/"),
    ("firmware for RV32IM", r"firmware"),
    ("tests: portable core", r"tests/(unit/(base|geometry|wire|lighthouse|pose|track|report)|fuzz|checks|support)/"),
    ("tests: host and tools", r"tests/(unit/(host|sim|tools)|integration)/"),
    ("tests: capture logic", r"tests/rtl/"),
    ("tests: else", r"tests/"),
)


def part_of(output):
    return next((name for name, pattern in PARTS if re.match(pattern, output)), "else")


def steps(build):
    """Output -> seconds; several outputs of one step have the same start, end and command and count once."""
    last = {}
    for line in (build / ".ninja_log").read_text().splitlines():
        if not line.startswith("#"):
            start, end, _, output, command = line.split("\t")
            last[output] = (int(start), int(end), command)
    found = {}
    for output, step in last.items():
        found.setdefault(step, output)
    return {output: (end - start) / 1000.0 for (start, end, _), output in found.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=0)
    arguments = parser.parse_args()
    cost = steps(arguments.build)
    sums = collections.Counter()
    counts = collections.Counter()
    for output, seconds in cost.items():
        sums[part_of(output)] += seconds
        counts[part_of(output)] += 1
    whole = sum(sums.values())
    print("| part | steps | s | share |\n|---|---|---|---|")
    for part, seconds in sums.most_common():
        print(f"| {part} | {counts[part]} | {seconds:.0f} | {100.0 * seconds / whole:.0f} % |")
    print(f"| all | {len(cost)} | {whole:.0f} | 100 % |")
    for output in sorted(cost, key=cost.get, reverse=True)[: arguments.files]:
        print(f"{cost[output]:7.1f} {output}")


if __name__ == "__main__":
    main()
