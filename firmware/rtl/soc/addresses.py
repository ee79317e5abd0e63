#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The address map of addresses.toml as Verilog, C++ and a table: written, or with --check compared with the files."""

import argparse
import pathlib
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
BOARD = HERE.parents[1] / "board" / "chip" / "addresses.hpp"
BEGIN, END = "<!-- addresses.py -->\n", "<!-- end -->\n"


def camel(name):
    return "k" + "".join(part.capitalize() for part in name.split("_"))


def verilog(table):
    lines = ["// SPDX-License-Identifier: Apache-2.0", "// Made by addresses.py of addresses.toml."]
    for row in table["memory"]:
        lines.append(f"localparam [31:12] PAGE_OF_{row['name'].upper()} = 20'h{row['address'] >> 12:05X};")
    for row in table["device"]:
        lines.append(f"localparam [31:12] PAGE_OF_{row['name'].upper()} = 20'h{row['address'] >> 12:05X};")
    return "\n".join(lines) + "\n"


def header(table):
    lines = ["// SPDX-License-Identifier: Apache-2.0", "// Made by firmware/rtl/soc/addresses.py of addresses.toml.", "#pragma once", "",
             "#include <cstdint>", "", "namespace pharos::board {", ""]
    for row in table["device"]:
        lines += [f"/// {row['what']}.", f"inline constexpr std::uintptr_t {camel(row['name'])} = 0x{row['address']:08X};"]
    return "\n".join(lines + ["", "}  // namespace pharos::board"]) + "\n"


def readme(table):
    lines = ["| address | bytes | what |", "|---|---|---|"]
    lines += [f"| 0x{row['address']:08X} | 0x{row['bytes']:X} | {row['name']}: {row['what']} |" for row in table["memory"]]
    lines += [f"| 0x{row['address']:08X} | 0x1000 | {row['name']}: {row['what']} |" for row in table["device"]]
    return "\n".join(lines) + "\n"


def with_table(text, table):
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    return text[:begin] + readme(table) + text[end:]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    table = tomllib.loads((HERE / "addresses.toml").read_text())
    rows = table["memory"] + table["device"]
    if any(row["address"] % 0x1000 for row in rows) or len({row["address"] for row in rows}) != len(rows):
        sys.exit("addresses.toml: addresses must be different pages of 4 KiB")
    readme_path = HERE / "README.md"
    files = {HERE / "soc_addresses.vh": verilog(table), BOARD: header(table),
             readme_path: with_table(readme_path.read_text(), table)}
    stale = [path for path, text in files.items() if not path.exists() or path.read_text() != text]
    for path in stale:
        if check:
            print(f"{path} is not what addresses.py makes of addresses.toml")
        else:
            path.write_text(files[path])
    return 1 if check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
