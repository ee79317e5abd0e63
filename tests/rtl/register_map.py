#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads capture_registers.h: prints the register table for the README, or checks README and Verilog against the header.

usage: register_map.py FOLDER | register_map.py --check FOLDER
"""

import pathlib
import re
import sys
import tempfile

DEFINE = re.compile(r"#define PHAROS_CAPTURE_(?P<name>\w+)_OFFSET 0x(?P<offset>[0-9A-F]{2})\s*/\* (?P<text>.*) \*/")
ADDRESS = re.compile(r"localparam \[3:0\] ADDRESS_(?P<name>\w+) = 4'h(?P<address>[0-9A-F]);")
ACCESS = re.compile(r"(?P<access>RW?): (?P<meaning>.*)")
MAP_BYTES = 64


def registers(header):
    """Name -> (offset, access, meaning), in the header's order."""
    found = {}
    for line in header.splitlines():
        match = DEFINE.match(line)
        if match:
            access = ACCESS.match(match["text"])
            found[match["name"]] = (int(match["offset"], 16), access["access"], access["meaning"])
    return found


def table(header):
    lines = ["| offset | register | access | meaning |", "|---|---|---|---|"]
    for name, (offset, access, meaning) in registers(header).items():
        lines.append(f"| 0x{offset:02X} | {name} | {access} | {meaning} |")
    return "\n".join(lines)


def objections(folder):
    header = (folder / "capture_registers.h").read_text()
    verilog = (folder / "capture_queue.v").read_text()
    of_header = {name: offset for name, (offset, _, _) in registers(header).items()}
    of_verilog = {match["name"]: 4 * int(match["address"], 16) for match in ADDRESS.finditer(verilog)}
    if len(of_header) < 2:
        yield "capture_registers.h: no registers found"
    for name in sorted(of_header.keys() | of_verilog.keys()):
        if of_header.get(name) != of_verilog.get(name):
            yield f"{name}: header {of_header.get(name)}, Verilog {of_verilog.get(name)}"
    if len(set(of_header.values())) != len(of_header) or any(o % 4 or o >= MAP_BYTES for o in of_header.values()):
        yield "capture_registers.h: offsets must be different words of the 64 bytes"
    if table(header) not in (folder / "README.md").read_text():
        yield f"README.md: its register table is not the one that `{pathlib.Path(__file__).name} {folder.name}` prints"


def planted_faults_are_found(folder):
    """A change in any of the three files must be reported."""
    faults = (("capture_registers.h", "LOST_OFFSET 0x20", "LOST_OFFSET 0x3C"), ("README.md", "| 0x20 |", "| 0x24 |"),
      ("capture_queue.v", "ADDRESS_LOST = 4'h8", "ADDRESS_LOST = 4'hF"))
    for file, original, replacement in faults:
        with tempfile.TemporaryDirectory() as copy:
            for name in ("capture_registers.h", "capture_queue.v", "README.md"):
                text = (folder / name).read_text()
                (pathlib.Path(copy) / name).write_text(text.replace(original, replacement) if name == file else text)
            if not list(objections(pathlib.Path(copy))):
                yield f"a wrong register in {file} was not found"


def main():
    arguments = sys.argv[1:]
    check = arguments[:1] == ["--check"]
    if len(arguments) != (2 if check else 1):
        sys.exit(__doc__)
    folder = pathlib.Path(arguments[-1])
    if not check:
        print(table((folder / "capture_registers.h").read_text()))
        return 0
    found = list(objections(folder)) or list(planted_faults_are_found(folder))
    for objection in found:
        print(objection)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
