#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: rom_words.py LOADER.bin LOADER.hex: the loader as `$readmemh` reads it, the ROM's 1,536 words of 32 bits a line each."""

import pathlib
import struct
import sys

ROM_WORDS = 1536


def words(code):
    """Little-endian; zeros to the end of the ROM."""
    if len(code) > 4 * ROM_WORDS:
        raise ValueError(f"{len(code)} bytes do not fit the {4 * ROM_WORDS} of the ROM")
    return struct.unpack(f"<{ROM_WORDS}I", code.ljust(4 * ROM_WORDS, b"\0"))


def main():
    source, output = map(pathlib.Path, sys.argv[1:])
    try:
        output.write_text("".join(f"{word:08x}\n" for word in words(source.read_bytes())))
    except (OSError, ValueError) as error:
        print(f"rom_words: {source}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
