#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Rules for any source file: licence line, no leftovers, no file too long."""

import argparse
import pathlib
import re
import sys

FOLDERS = ("cmake", "common", "firmware", "host", "proto", "tools", "tests", ".ci")
TOP_LEVEL = ("CMakeLists.txt",)
SUFFIXES = {".hpp", ".cpp", ".h", ".c", ".py", ".sh", ".cmake", ".toml", ".lcm", ".in", ".service", ".rules", ".v", ".ld"}
CODE = {".hpp", ".cpp", ".h", ".c", ".py", ".sh", ".v", ""}
LICENCE = "SPDX-License-Identifier: Apache-2.0"
LICENCE_WITHIN_LINES = 3
MOST_LINES = 400
# Written so that the patterns do not match this file.
LEFTOVERS = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX|[Ss]t" r"ub(bed|s)?|[Nn]ot imp" r"lemented)\b")


def is_script(path):
    with path.open("rb") as file:
        return file.read(2) == b"#!"


def sources(root):
    for name in TOP_LEVEL:
        if (root / name).is_file():
            yield root / name
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if not path.is_file() or "__pycache__" in path.parts or "corpus" in path.parts:
                continue
            if path.name == "CMakeLists.txt" or path.suffix in SUFFIXES or (path.suffix == "" and is_script(path)):
                yield path


def violations(root):
    for path in sources(root):
        name = path.relative_to(root).as_posix()
        lines = path.read_text().splitlines()
        if not any(LICENCE in line for line in lines[:LICENCE_WITHIN_LINES]):
            yield f"{name}:1: the line '{LICENCE}' is missing"
        if path.suffix in CODE and len(lines) > MOST_LINES:
            yield f"{name}:{MOST_LINES}: {len(lines)} lines; split it by idea"
        for number, line in enumerate(lines, 1):
            match = LEFTOVERS.search(line)
            if match:
                yield f"{name}:{number}: '{match.group()}' is a leftover"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    found = list(violations(parser.parse_args().root.resolve()))
    for violation in found:
        print(violation)
    print(f"{len(found)} house rules broken")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
