#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Resources of the capture logic on a Cyclone IV E, counted by yosys (without place and route).

Logic elements: look-up tables, plus the flip-flops that cannot share an element with the table that drives them.
`--check` holds the block that flies (12 inputs, 512 records) to its budget, and shows that the budget can be broken.
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
TABLE_INPUTS = (4, 8, 12, 16, 24, 32)
FLYING_INPUTS = 12
FLYING_DEPTH = 512
MOST_LOGIC_ELEMENTS = 1000
MOST_M9K = 4
TOP = "pharos_capture"


def netlist(sources, inputs, depth):
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "netlist.json"
        read = (f"read_verilog {' '.join(map(str, sources))}", f"chparam -set INPUTS {inputs} -set DEPTH {depth} {TOP}")
        script = (*read, f"hierarchy -check -top {TOP}", "proc", "select -assert-none t:$dlatch t:$adlatch", "design -reset",
          *read, f"synth_intel -family cycloneive -top {TOP}", f"write_json {output}")
        done = subprocess.run(["yosys", "-q", "-p", "\n".join(script)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        return json.loads(output.read_text())["modules"][TOP]["cells"].values()


def cost(sources, inputs, depth):
    cells = netlist(sources, inputs, depth)
    count = collections.Counter(cell["type"] for cell in cells)
    tables = {bit for cell in cells if cell["type"] == "cycloneive_lcell_comb" for bit in cell["connections"]["combout"]}
    alone = 0
    for cell in cells:
        if cell["type"] == "dffeas":
            driver = cell["connections"]["d"][0]
            alone += driver not in tables
            tables.discard(driver)  # one flip-flop an element
    return {"tables": count["cycloneive_lcell_comb"], "flip_flops": count["dffeas"],
      "elements": count["cycloneive_lcell_comb"] + alone, "m9k": count["altsyncram"]}


def within_budget(row):
    return row["elements"] <= MOST_LOGIC_ELEMENTS and row["m9k"] <= MOST_M9K


def check(sources):
    row = cost(sources, FLYING_INPUTS, FLYING_DEPTH)
    print(f"{FLYING_INPUTS} inputs, {FLYING_DEPTH} records: {row['elements']} logic elements of {MOST_LOGIC_ELEMENTS}, "
      f"{row['m9k']} M9K of {MOST_M9K}")
    twice = cost(sources, FLYING_INPUTS, 2 * FLYING_DEPTH)
    if within_budget(twice):
        sys.exit(f"a FIFO twice as deep passes as well ({twice}): this check cannot fail")
    return 0 if within_budget(row) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", nargs="*", type=pathlib.Path, help="default: firmware/rtl/*.v")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    sources = arguments.sources or sorted((pathlib.Path(__file__).parents[2] / "firmware/rtl").glob("*.v"))
    if shutil.which("yosys") is None:
        print("skipped: yosys is not installed (tools/install-dependencies test)")
        return SKIPPED
    if arguments.check:
        return check(sources)
    print("| inputs | logic elements | look-up tables | flip-flops | M9K blocks | bits a record |")
    print("|---|---|---|---|---|---|")
    for inputs in TABLE_INPUTS:
        row = cost(sources, inputs, FLYING_DEPTH)
        print(f"| {inputs} | {row['elements']} | {row['tables']} | {row['flip_flops']} | {row['m9k']} | {33 + 2 * inputs} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
