#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: quartus_project.py FIRMWARE_RTL STUB: holds the vendor's project (firmware/rtl/ep4ce10) to the Verilog. Every source is listed
and there, and nothing else; every bit of a port has one pin, which no other has and which the package has for it; clock constraint,
PLL and the chip's constant agree; every port has its time limited, the SDRAM's by its sheet; Verilator elaborates the listed files.
Each rule is seen to fail on a planted fault. 77 = skipped."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROJECT, TOP, STUB = "ep4ce10", "ep4ce10_board", None
# The package's user pins of 3.3 V, by rows, from the fitter's pin report of the board's maker (README of ep4ce10).
USER_PINS = {
    "A": "2 3 4 5 6 7 8 9 10 11 12 13 14 15", "B": "1 3 4 5 6 7 8 9 10 11 12 13 14 16", "C": "1 2 3 6 8 9 11 14 15 16",
    "D": "1 2 3 4 5 6 8 9 11 12 14 15 16", "E": "1 5 6 7 8 9 10 11 15 16", "F": "1 2 3 5 6 7 8 9 10 11 13 14 15 16",
    "G": "1 2 5 11 15 16", "H": "1 2", "J": "1 2 6 11 12 13 14 15 16", "K": "1 2 5 6 8 9 10 11 12 15 16",
    "L": "1 2 3 4 6 7 8 9 10 11 12 13 14 15 16", "M": "1 2 6 7 8 9 10 11 12 15 16", "N": "1 2 3 5 6 8 9 11 12 13 14 15 16",
    "P": "1 2 3 6 8 9 11 14 15 16", "R": "1 3 4 5 6 7 8 9 10 11 12 13 14 16", "T": "2 3 4 5 6 7 8 9 10 11 12 13 14 15"}
PINS = {row + number for row, numbers in USER_PINS.items() for number in numbers.split()}
INPUT_ONLY = {"E1", "E15", "E16", "M1", "M2", "M15", "M16"}  # dedicated clock inputs
# The slowest of the sheets that README names, CAS latency 2; the longest line on the board.
SDRAM_NS = {"access": 6.0, "output_hold": 2.5, "setup": 2.0, "hold": 1.0}
LINE_NS = 0.5
PORT = re.compile(r"^\s*(input|output|inout)\s+wire\s*(?:\[\s*(\d+):0\])?\s*(\w+)", re.MULTILINE)
GLOBAL = re.compile(r'^set_global_assignment -name (\w+) "?([^"\n]+)"?$', re.MULTILINE)
LOCATION = re.compile(r"^set_location_assignment PIN_(\w+) -to (\S+)$", re.MULTILINE)
INSTANCE = re.compile(r"^set_instance_assignment -name \w+ \w+ -to (\S+)$", re.MULTILINE)


def ports(verilog):
    """Name of each bit -> direction."""
    return {name if high == "" else f"{name}[{bit}]": way for way, high, name in PORT.findall(verilog)
            for bit in range(int(high or 0) + 1)}


def limited(limits, bits):
    """(bit, "to" or "from" it, "max" or "min") of every bit whose time is limited, or told not to matter."""
    done = set()
    for command, options, names in re.findall(r"^set_(\w+) (.*?)\[get_ports \{?([^\n}]*?)\}?\][ \d.]*$", limits, re.MULTILINE):
        way = {"output_delay": "to", "input_delay": "from"}.get(command) or options.split()[0][1:]
        kinds = ("max", "min") if command == "false_path" else re.findall("max|min", f"{command} {options}")
        bases = names.replace("[*]", "").split()
        done |= {(bit, way, kind) for bit in bits for kind in kinds if bit.split("[")[0] in bases}
    return done


def timing_objections(limits, bits, board, phase_ns, period_ns):
    constant = set(re.findall(r"assign (\w+) = 1'b[01];", board))
    there = limited(limits, bits)
    for bit, way in bits.items():
        if bit.split("[")[0] in constant or f"[get_ports {bit}]" in "".join(re.findall(r"^create_.*$", limits, re.MULTILINE)):
            continue
        for side, absent in (("to", way == "input"), ("from", way == "output")):
            yield from (f"{bit} has no {kind} delay {side} it" for kind in ("max", "min") if not absent and (bit, side, kind) not in there)
    delay = {(way, kind): float(ns) for way, kind, ns in
             re.findall(r"^set_(input|output)_delay -clock sdram_clock -(max|min) (-?[\d.]+) ", limits, re.MULTILINE)}
    if delay != {("input", "max"): SDRAM_NS["access"] + 2 * LINE_NS, ("input", "min"): SDRAM_NS["output_hold"],
                 ("output", "max"): SDRAM_NS["setup"] + LINE_NS, ("output", "min"): -SDRAM_NS["hold"] - LINE_NS}:
        yield f"the SDRAM's delays are not those of its sheet: {delay}"
        return
    if "set_multicycle_path -setup 2 -from [get_clocks sdram_clock]" not in limits:
        yield "the SDRAM's data are not taken at the second edge"
    # What is left for the ways through the chip's pins: of a command or data beside the clock, of the clock and data one after the other.
    left = {"commands at the latest": period_ns - phase_ns - delay["output", "max"], "commands at the earliest": phase_ns + delay["output", "min"],
            "data at the latest": period_ns + phase_ns - delay["input", "max"], "data at the earliest": delay["input", "min"] - phase_ns}
    for name, least in (("commands at the latest", 10), ("commands at the earliest", 1), ("data at the latest", 15), ("data at the earliest", -1)):
        if left[name] < least:
            yield f"SDRAM, {name}: {left[name]} ns left"


def objections(rtl):
    folder = rtl / PROJECT
    project, settings, limits = ((folder / f"pharos.{kind}").read_text() for kind in ("qpf", "qsf", "sdc"))
    if 'PROJECT_REVISION = "pharos"' not in project:
        yield "pharos.qpf names another revision"
    assignments = {}
    for name, value in GLOBAL.findall(settings):
        assignments.setdefault(name, []).append(value)
    if assignments.get("TOP_LEVEL_ENTITY") != [TOP] or assignments.get("DEVICE") != ["EP4CE10F17C8"]:
        yield "top or device"
    listed = [(folder / name).resolve() for name in assignments["VERILOG_FILE"]]
    there = {path.resolve() for part in (".", "core", "soc", PROJECT) for path in (rtl / part).glob("*.v")}
    yield from (f"{path.name} is not there" for path in listed if not path.exists())
    yield from (f"{path.name} is listed twice" for path in set(listed) if listed.count(path) > 1)
    yield from (f"{path.name} is not listed" for path in there - set(listed))
    for file in assignments["SDC_FILE"] + assignments["SEARCH_PATH"]:
        if not (folder / file).exists():
            yield f"{file} is not there"

    board = (folder / f"{TOP}.v").read_text()
    bits = ports(board)
    places = LOCATION.findall(settings)
    for bit, way in bits.items():
        pins = [pin for pin, port in places if port == bit]
        if len(pins) != 1:
            yield f"{bit} has {len(pins)} pins"
        elif pins[0] in INPUT_ONLY and way != "input":
            yield f"{bit} on {pins[0]}, which is an input only"
    yield from (f"{port} is no port" for port in {port for _, port in places} | set(INSTANCE.findall(settings)) if port not in bits)
    used = [pin for pin, _ in places]
    yield from (f"pin {pin} is used twice" for pin in set(used) if used.count(pin) > 1)
    yield from (f"{pin} is no user pin of the package" for pin in used if pin not in PINS)

    rate = int(re.search(r"\.CLOCK_HZ\((\d+)\)", (rtl / "soc/pharos_chip.v").read_text())[1])
    period = re.search(r"^create_clock -name \w+ -period ([\d.]+) \[get_ports (\w+)\]$", limits, re.MULTILINE)
    pll = (folder / "chip_pll.v").read_text()
    number = {name: int(value) for name, value in re.findall(r"\.(\w+)\((\d+)\)", pll)}
    if period is None or period[2] not in bits:
        yield "the clock's constraint names no port"
    elif abs(float(period[1]) * rate - 1e9) > 1:
        yield f"a period of {period[1]} ns is not that of {rate} Hz"
    if number["inclk0_input_frequency"] * rate != 10**12 or any(number[f"clk{i}_multiply_by"] != number[f"clk{i}_divide_by"] for i in (0, 1)):
        yield f"the PLL does not make {rate} Hz of its input"
    phase = re.search(r'\.clk1_phase_shift\("-(\d+)"\)', pll)
    yield from timing_objections(limits, bits, board, int(phase[1]) / 1000 if phase else 0.0, 1e9 / rate)
    yield from (f"{port} in pharos.sdc is no port" for group in re.findall(r"get_ports \{?([^\]}]*(?:\[\*\][^\]}]*)*)", limits)
                for port in re.findall(r"[a-z_0-9]+", group.replace("[*]", "")) if not any(bit.split("[")[0] == port for bit in bits))
    if shutil.which("verilator") and all(path.exists() for path in listed):
        command = ["verilator", "--lint-only", "-Wall", f"-I{rtl / 'soc'}", "--top-module", TOP, *map(str, dict.fromkeys(listed)), str(STUB)]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            yield "verilator: " + run.stderr.strip()[:400]


FAULTS = (  # file, text, replacement
    ("ep4ce10/pharos.qsf", "set_location_assignment PIN_M2 -to uart_receive\n", ""),
    ("ep4ce10/pharos.qsf", "PIN_M2 -to uart_receive", "PIN_N1 -to uart_receive"),
    ("ep4ce10/pharos.qsf", "PIN_N1 -to uart_transmit", "PIN_M1 -to uart_transmit"),
    ("ep4ce10/pharos.qsf", "PIN_T8 -to", "PIN_A1 -to"),
    ("ep4ce10/pharos.qsf", "-to leds[3]", "-to leds[4]"),
    ("ep4ce10/pharos.qsf", "set_global_assignment -name VERILOG_FILE ../core/core_alu.v\n", ""),
    ("ep4ce10/pharos.qsf", "../core/core_alu.v", "../core/core_sum.v"),
    ("ep4ce10/pharos.sdc", "-period 20.000", "-period 25.000"),
    ("ep4ce10/pharos.sdc", "get_ports flash_in]", "get_ports flash_input]"),
    ("ep4ce10/chip_pll.v", ".clk0_multiply_by(1)", ".clk0_multiply_by(2)"),
    ("ep4ce10/chip_pll.v", ".clk1_divide_by(1)", ".clk1_divide_by(2)"),
    ("ep4ce10/pharos.sdc", "-max 7.000", "-max 6.400"),
    ("ep4ce10/pharos.sdc", "-min -1.500 [get_ports {sdram_ras_n ", "-min -1.500 [get_ports {"),
    ("ep4ce10/pharos.sdc", "set_multicycle_path -setup 2", "set_multicycle_path -setup 1"),
    ("ep4ce10/pharos.sdc", "uart_transmit leds", "leds"),
    ("ep4ce10/chip_pll.v", '("-3000")', '("-9000")'),
    ("ep4ce10/chip_pll.v", '("-3000")', '("0")'),
    ("ep4ce10/pharos.qsf", "PIN_B14 -to sdram_clock\n", "PIN_M1 -to sdram_clock\n"),
    ("ep4ce10/ep4ce10_board.v", "output wire [ 3:0] leds", "output wire [ 4:0] leds"),
    ("soc/pharos_chip.v", ".CLOCK_HZ(50000000)", ".CLOCK_HZ(48000000)"),
)


def main():
    global STUB
    rtl, STUB = (pathlib.Path(name).resolve() for name in sys.argv[1:])
    found = list(objections(rtl))
    for text in found:
        print("FAILED:", text)
    with tempfile.TemporaryDirectory() as folder:
        for file, text, replacement in FAULTS:
            copy = pathlib.Path(folder) / "rtl"
            shutil.copytree(rtl, copy)
            content = (copy / file).read_text()
            if text not in content:
                found.append(f"the fault {text!r} cannot be planted in {file}")
                print("FAILED:", found[-1])
            (copy / file).write_text(content.replace(text, replacement))
            if not any(objections(copy)):
                found.append(f"{replacement!r} in {file} was not found")
                print("FAILED:", found[-1])
            shutil.rmtree(copy)
    if not found and not shutil.which("verilator"):
        print("skipped: all but Verilator's elaboration passed; verilator is not installed (tools/install-dependencies test)")
        return 77
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
