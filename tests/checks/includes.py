#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the #include lines of every source file and fails when a room reaches where it may not (rooms.toml)."""

import argparse
import fnmatch
import pathlib
import re
import sys
import tomllib

FOLDERS = ("common", "firmware", "host", "tools", "tests")
SUFFIXES = {".hpp", ".cpp", ".h", ".c", ".cc", ".in"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(?P<open>[<"])(?P<name>[^>"]+)[>"]')
INCLUDE_ROOTS = ("common", "", "tests")


def inside(path, room):
    return path == room or path.startswith(room + "/")


class Rules:
    def __init__(self, file):
        table = tomllib.loads(file.read_text())
        self.rooms = table["rooms"]
        self.third_party = table["third_party"]
        self.standard = table["standard"]

    def room_of(self, path):
        matches = [room for room in self.rooms if inside(path, room)]
        return max(matches, key=len, default=None)

    def third_party_of(self, name):
        for library, rule in self.third_party.items():
            if any(fnmatch.fnmatchcase(name, start if "*" in start else start + "*") for start in rule["starts"]):
                return library
        return None

    def objection(self, file, name, target):
        """Why `file` may not include `name` (found at `target` inside the project, or None); None if it may."""
        room = self.room_of(file)
        if room is None:
            return f"{file} belongs to no room of rooms.toml"
        if target is not None:
            if inside(target, room) or any(inside(target, allowed) for allowed in self.rooms[room]):
                return None
            return f"{room} may not reach {self.room_of(target) or target}"
        library = self.third_party_of(name)
        if library is not None:
            if any(inside(file, allowed) for allowed in self.third_party[library]["allowed"]):
                return None
            return f"{library} is not for {room}"
        if any(inside(file, restricted) for restricted in self.standard["restricted"]):
            if name not in self.standard["allowed"]:
                return "not on the list of headers for the portable core"
            return None
        return None


def target_of(root, file, name, quoted):
    """Path inside the project that an include of `name` in `file` finds, or None."""
    candidates = [(root / file).parent / name] if quoted else []
    candidates += [root / base / name for base in INCLUDE_ROOTS]
    for candidate in candidates:
        if candidate.is_file():
            return candidate.resolve().relative_to(root).as_posix()
    return None


def sources(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES and path.is_file():
                yield path.relative_to(root).as_posix()


def violations(root, rules):
    for file in sources(root):
        for number, line in enumerate((root / file).read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if match is None:
                continue
            name = match["name"]
            reason = rules.objection(file, name, target_of(root, file, name, match["open"] == '"'))
            if reason is not None:
                yield f"{file}:{number}: {name}: {reason}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--rules", type=pathlib.Path, default=pathlib.Path(__file__).with_name("rooms.toml"))
    arguments = parser.parse_args()
    found = list(violations(arguments.root.resolve(), Rules(arguments.rules)))
    for violation in found:
        print(violation)
    print(f"{len(found)} includes reach where they may not")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
