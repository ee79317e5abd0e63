#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Resources of the whole chip on an EP4CE10, counted by yosys (without place and route).

Logic elements as in cost_table.py. RAM, ROM and multipliers are black boxes, because yosys infers none of them for this family: they
are counted from their sizes. `--check` holds the chip to its budget.
"""

import argparse
import collections
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
ROOT = pathlib.Path(__file__).resolve().parents[3]
RTL = ROOT / "firmware" / "rtl"
TOP = "pharos_chip"
MAX_LOGIC_ELEMENTS = 5000
MAX_M9K = 46
# Black boxes: M9K and multipliers of 9 bits of one. A lane is 8,192 x 8 bits, the ROM 1,536 x 32, an M9K 1,024 x 8 or 256 x 32.
BOXES = {"soc_ram_lane": (8, 0), "soc_rom": (6, 0), "soc_cache_tags": (1, 0), "soc_cache_half": (1, 0), "core_multiplier": (0, 2)}


def netlist():
    sources = [path for folder in (RTL, RTL / "core", RTL / "soc") for path in sorted(folder.glob("*.v"))]
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "netlist.json"
        (pathlib.Path(folder) / "loader.hex").write_text("0\n" * 1536)
        script = (f"read_verilog -I{RTL / 'soc'} {' '.join(map(str, sources))}",
                  f"hierarchy -check -top {TOP}", *(f"blackbox {name} *{name}*" for name in BOXES),
                  f"synth_intel -family cycloneive -top {TOP}", f"write_json {output}")
        done = subprocess.run(["yosys", "-q", "-p", "\n".join(script)], capture_output=True, text=True, check=False, cwd=folder)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        return json.loads(output.read_text())["modules"][TOP]["cells"].values()


def cost():
    cells = netlist()
    count = collections.Counter(cell["type"] for cell in cells)
    tables = {bit for cell in cells if cell["type"] == "cycloneive_lcell_comb" for bit in cell["connections"]["combout"]}
    alone = 0
    for cell in cells:
        if cell["type"] == "dffeas":
            driver = cell["connections"]["d"][0]
            alone += driver not in tables
            tables.discard(driver)
    boxes = {name: sum(number for kind, number in count.items() if name in kind) for name in BOXES}
    return {"elements": count["cycloneive_lcell_comb"] + alone, "tables": count["cycloneive_lcell_comb"],
            "flip_flops": count["dffeas"], "m9k": count["altsyncram"] + sum(BOXES[name][0] * number for name, number in boxes.items()),
            "multipliers": sum(BOXES[name][1] * number for name, number in boxes.items()), "inferred": count["altsyncram"],
            "boxes": boxes}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    if shutil.which("yosys") is None:
        print("skipped: yosys is not installed (tools/install-dependencies test)")
        return SKIPPED
    row = cost()
    print(row)
    within = row["elements"] <= MAX_LOGIC_ELEMENTS and row["m9k"] <= MAX_M9K and all(row["boxes"].values())
    return 0 if within or not check else 1


if __name__ == "__main__":
    sys.exit(main())
