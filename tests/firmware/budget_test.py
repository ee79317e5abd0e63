#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: budget_test.py IMAGES: sections of the board's images compared with its block RAM. Prints the table of
firmware/README.md."""

import pathlib
import subprocess
import sys

RETAINED = 32
LOADER = 4096  # its whole section
CHIP = 36 * 1024
UPPER = 2048  # of the loader's ROM, for SHA-256 and the checks of signature and version
VERIFIER = 8192  # in flash
SLOT = 256 * 1024
UP5K_SLOT = 128 * 1024
# Most bytes of variables and stack, and of everything (code, constants, variables, stack, loader) together.
LIMITS = {"decoder.ep4ce10": (12 * 1024, CHIP), "decoder_pose.ep4ce10": (CHIP, None)}


def sections(elf):
    text = subprocess.run(["riscv64-unknown-elf-size", "-A", elf], capture_output=True, text=True, check=True).stdout
    return {fields[0]: int(fields[1]) for fields in map(str.split, text.splitlines()) if len(fields) == 3 and fields[1].isdigit()}


def main():
    images = pathlib.Path(sys.argv[1])
    failed = False
    print("| image | code and constants | hot code | variables | stack | variables + stack | with loader | of 36,864 |")
    print("|---|---|---|---|---|---|---|---|")
    for name, (max_ram, max_all) in LIMITS.items():
        elf = images / f"{name}.elf"
        if not elf.exists():
            continue
        size = sections(elf)
        code = size[".text"] + size[".rodata"]
        variables = size[".data"] + size[".bss"] + RETAINED
        ram = variables + size[".stack"]
        on_chip = ram + size[".hot"] + LOADER + (code if max_all else 0)
        print(f"| {name} | {code:,} | {size['.hot']:,} | {variables:,} | {size['.stack']:,} | {ram:,} | {on_chip:,} | "
              f"{CHIP - on_chip:+,} |")
        if ram > max_ram or on_chip > (max_all or CHIP):
            print(f"FAILED: {name} is over its budget of {max_ram:,} variables and stack, {max_all or CHIP:,} in all")
            failed = True
    for image in sorted(images.glob("decoder*.image")):
        slot = UP5K_SLOT if ".up5k" in image.name else SLOT
        print(f"{image.name}: {image.stat().st_size:,} bytes of the {slot:,} of a slot")
        if image.stat().st_size > slot:
            print(f"FAILED: {image.name} fits no slot of the loader's flash")
            failed = True
    loaders = [sections(images / f"{board}_loader.elf") for board in ("ep4ce10", "up5k")]
    upper = max(loader[".upper"] for loader in loaders)
    verifier = (images / "verifier.bin").stat().st_size
    print(f"signatures, apart: {upper:,} bytes of the {UPPER:,} of ROM after the loader; {verifier:,} of the {VERIFIER:,} of the verifier in flash")
    if upper > UPPER or verifier > VERIFIER:
        print("FAILED: the signatures are over their budget")
        failed = True
    largest = max(loader[".text"] for loader in loaders)
    if largest > LOADER:
        print(f"FAILED: a loader has {largest} bytes of {LOADER}")
        failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
