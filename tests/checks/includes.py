#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the #include lines of every source file and fails when a room reaches where it may not (rooms.toml), when a folder
has no row of its own there, and when rows allow a cycle."""

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
# Folders of these have a row each; tests may include all and is one room.
LAYERED = ("common", "firmware", "host", "tools")


def inside(path, room):
    return path == room or path.startswith(room + "/")


class Rules:
    def __init__(self, file):
        table = tomllib.loads(file.read_text())
        self.rooms = table["rooms"]
        self.third_party = table["third_party"]
        self.standard = table["standard"]
        self.parts = table.get("parts", {})

    def room_of(self, path):
        matches = [room for room in self.rooms if inside(path, room)]
        return max(matches, key=len, default=None)

    def covers(self, allowed, path, room):
        """A row that names a room means that room, not the rooms in its folder; any other path means all that lies in it."""
        return room == allowed if allowed in self.rooms else inside(path, allowed)

    def is_part(self, folder):
        """Whether `folder` belongs to the room above it: rooms may declare their folders as parts of themselves."""
        return any(inside(folder, part) for part in self.parts.get("of_the_room_above", ()))

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
            other = self.room_of(target)
            if other == room or any(self.covers(allowed, target, other) for allowed in self.rooms[room]):
                return None
            return f"{room} may not reach {other or target}"
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


def folders_without_row(root, rules):
    folders = {pathlib.PurePosixPath(file).parent.as_posix() for file in sources(root) if not file.endswith(".in")}
    for folder in sorted(folders):
        if folder.split("/")[0] in LAYERED and folder not in rules.rooms and not rules.is_part(folder):
            yield f"{folder}: no row of its own in rooms.toml"


def cycle(rules):
    """A cycle of rooms by their rows, in order, or None."""
    reach = {room: sorted(other for other in rules.rooms
                          if other != room and any(rules.covers(path, other, other) for path in allowed))
             for room, allowed in rules.rooms.items() if room.split("/")[0] in LAYERED}
    done, way = set(), []

    def visit(room):
        if room in way:
            return way[way.index(room):] + [room]
        if room in done:
            return None
        way.append(room)
        found = next(filter(None, map(visit, reach.get(room, ()))), None)
        way.pop()
        done.add(room)
        return found

    return next(filter(None, map(visit, sorted(reach))), None)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--rules", type=pathlib.Path, default=pathlib.Path(__file__).with_name("rooms.toml"))
    arguments = parser.parse_args()
    rules = Rules(arguments.rules)
    root = arguments.root.resolve()
    found = [*violations(root, rules), *folders_without_row(root, rules)]
    rooms = cycle(rules)
    if rooms is not None:
        found.append("rows of rooms.toml allow a cycle: " + " -> ".join(rooms))
    for violation in found:
        print(violation)
    print(f"{len(found)} includes or rows break the layering")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
