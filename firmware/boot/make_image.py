#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the image that `pharos flash` takes (common/pharos/boot_image/README.md) of a linked program, signed with the private
Ed25519 key of a PEM file (openssl genpkey -algorithm ed25519)."""

import argparse
import hashlib
import pathlib
import struct
import sys
import zlib

PAGE = 256
MAGIC = 0x474D4950
FORMAT = 2
PT_LOAD = 1


def segments(elf):
    """Load address and bytes of everything that the program needs in memory before it starts; and its entry."""
    if elf[:6] != b"\x7fELF\x01\x01":
        raise ValueError("is no 32-bit little-endian ELF file")
    entry, table = struct.unpack_from("<II", elf, 24)
    size, count = struct.unpack_from("<HH", elf, 42)
    found = []
    for i in range(count):
        kind, offset, _, address, bytes_in_file = struct.unpack_from("<IIIII", elf, table + i * size)
        if kind == PT_LOAD and bytes_in_file > 0:
            found.append((address, elf[offset : offset + bytes_in_file]))
    return entry, sorted(found)


def body_of(parts):
    """One run of bytes from the lowest load address on, gaps filled as erased flash is; a multiple of 4."""
    start = parts[0][0]
    body = bytearray()
    for address, data in parts:
        gap = address - start - len(body)
        if gap < 0 or gap > PAGE:
            raise ValueError(f"has parts that are not one piece: the one at {address:#x} is {gap} bytes behind the one before")
        body += b"\xff" * gap + data
    return start, bytes(body) + b"\xff" * (-len(body) % 4)


def signer(path):
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import load_pem_private_key

    key = load_pem_private_key(path.read_bytes(), None)
    if not isinstance(key, Ed25519PrivateKey):
        raise ValueError(f"{path} is no Ed25519 key")
    return key.sign


def image(board, name, version, load_address, entry, body, sign):
    if not load_address <= entry < load_address + len(body):
        raise ValueError(f"starts at {entry:#x}, outside its own bytes")
    header = struct.pack("<IIIIIBBBB24s12s", MAGIC, len(body), zlib.crc32(body), load_address, entry, FORMAT, *version, board, name)
    header += struct.pack("<I", zlib.crc32(header))
    header += hashlib.sha256(body).digest()
    if sign:
        header += sign(header)
    return header.ljust(PAGE, b"\xff") + body


def version(text):
    parts = tuple(int(part) for part in text.split("."))
    if len(parts) != 3 or not all(0 <= part <= 255 for part in parts):
        raise argparse.ArgumentTypeError(f"'{text}' is not three numbers of 0 to 255")
    return parts


def short_text(most):
    def convert(text):
        if not text.isascii() or not text.isprintable() or not 0 < len(text) <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not 1 to {most} printable ASCII characters")
        return text.encode()

    return convert


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--board", type=short_text(24), required=True)
    parser.add_argument("--name", type=short_text(12), required=True)
    parser.add_argument("--version", type=version, required=True)
    key = parser.add_mutually_exclusive_group()
    key.add_argument("--key", type=pathlib.Path, help="private key; without one the image is not signed")
    key.add_argument("--key-if-private", type=pathlib.Path, help="the same; a file with a public key signs nothing")
    parser.add_argument("elf", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        key = arguments.key
        if arguments.key_if_private and b"PRIVATE" in arguments.key_if_private.read_bytes():
            key = arguments.key_if_private
        sign = signer(key) if key else None
        entry, parts = segments(arguments.elf.read_bytes())
        if not parts:
            raise ValueError("holds nothing to load")
        load_address, body = body_of(parts)
        whole = image(arguments.board, arguments.name, arguments.version, load_address, entry, body, sign)
    except (OSError, ValueError, struct.error) as error:
        print(f"make_image: {arguments.elf}: {error}", file=sys.stderr)
        return 1
    arguments.output.write_bytes(whole)
    return 0


if __name__ == "__main__":
    sys.exit(main())
