#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the ctest entries of a GoogleTest program: one a suite, for a process a case would start the program 2,000 times.

A failing suite names its failing cases in the program's output. What can be skipped is one entry a case, since ctest would
take a suite with one skipped case for skipped whole, failures and all; a suite that skips unforeseen fails.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

SKIPS = ("GTEST_SKIP", "PHAROS_NEEDS_")
SKIPPED = r"\[  SKIPPED \]"


def cases_of(program):
    """(suite, case, source file) of every case."""
    with tempfile.TemporaryDirectory() as folder:
        listing = pathlib.Path(folder) / "cases.json"
        done = subprocess.run([program, "--gtest_list_tests", f"--gtest_output=json:{listing}"], capture_output=True,
                              text=True, timeout=60, check=False)
        if done.returncode != 0 or not listing.exists():
            sys.exit(f"{program} cannot list its cases:\n{done.stdout}{done.stderr}")
        suites = json.loads(listing.read_text())["testsuites"]
    return [(suite["name"], case["name"], case["file"]) for suite in suites for case in suite["testsuite"]]


class Sources:
    """What a case's file says about it. A compiler cache may have made the file's name relative."""

    def __init__(self, root, labels):
        self.root = root
        self.labels = labels
        self.skipping = {}

    def path_in_tests(self, file):
        parts = pathlib.PurePosixPath(file).parts
        starts = [i for i, part in enumerate(parts) if part == "tests"]
        paths = [pathlib.Path(*parts[i:]) for i in starts]
        return next((path for path in paths if (self.root / path).exists()), None)

    def label(self, file, default):
        return self.labels.get(str(self.path_in_tests(file)), default)

    def may_skip(self, file):
        if file not in self.skipping:
            path = self.path_in_tests(file)
            text = (self.root / path).read_text() if path else SKIPS[0]
            self.skipping[file] = any(word in text for word in SKIPS)
        return self.skipping[file]


def entries(cases, sources, default_label):
    """(name, filter, label, may skip) of every ctest entry."""
    groups = collections.defaultdict(list)
    for suite, case, file in cases:
        groups[suite, sources.label(file, default_label)].append((case, file))
    labels_of = collections.Counter(suite for suite, _ in groups)
    for (suite, label), members in groups.items():
        if label == "data" or any(sources.may_skip(file) for _, file in members):
            for case, _ in members:
                yield f"{suite}.{case}", f"{suite}.{case}", label, True
        elif labels_of[suite] == 1:
            yield suite, f"{suite}.*", label, False
        else:
            yield f"{suite}.{label}", ":".join(f"{suite}.{case}" for case, _ in members), label, False


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--name", required=True, help="put before each entry's name")
    parser.add_argument("--root", required=True, type=pathlib.Path, help="the project")
    parser.add_argument("--label", required=True)
    parser.add_argument("--file-label", action="append", default=[], help="tests/FILE=LABEL")
    parser.add_argument("--property", action="append", default=[], help="NAME=VALUE of every entry")
    arguments = parser.parse_args()
    sources = Sources(arguments.root, dict(pair.split("=", 1) for pair in arguments.file_label))
    lines = []
    for name, selection, label, may_skip in entries(cases_of(arguments.program), sources, arguments.label):
        test = f"[==[{arguments.name}.{name}]==]"
        properties = [("LABELS", label), *(pair.split("=", 1) for pair in arguments.property)]
        properties.append(("SKIP_REGULAR_EXPRESSION" if may_skip else "FAIL_REGULAR_EXPRESSION", SKIPPED))
        lines.append(f"add_test({test} [==[{arguments.program}]==] [==[--gtest_filter={selection}]==])\n")
        told = " ".join(f"{key} [==[{value}]==]" for key, value in properties)
        lines.append(f"set_tests_properties({test} PROPERTIES {told})\n")
    arguments.output.write_text("".join(lines))


if __name__ == "__main__":
    main()
