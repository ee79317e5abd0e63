#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The public key of a private key's file as C++ sees it, and the digest of a verifier: for the build."""

import argparse
import hashlib
import pathlib
import sys

from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat, load_pem_private_key


def public_key(path):
    """Its 32 bytes; `path`: a private key (PEM), or 64 hexadecimal digits."""
    text = path.read_bytes()
    if b"PRIVATE" in text:
        return load_pem_private_key(text, None).public_key().public_bytes(Encoding.Raw, PublicFormat.Raw)
    key = bytes.fromhex(text.decode().strip())
    if len(key) != 32:
        raise ValueError("is no key: 64 hexadecimal digits expected")
    return key


def as_list(data):
    return ", ".join(f"0x{byte:02x}" for byte in data)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("key", "digest"))
    parser.add_argument("input", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        if arguments.what == "key":
            text = f"#define PHAROS_PUBLIC_KEY {as_list(public_key(arguments.input))}\n"
        else:
            data = arguments.input.read_bytes()
            text = (f"#include <array>\n#include <cstdint>\nnamespace pharos::boot {{\n"
                    f"inline constexpr std::uint32_t kVerifierBytes = {len(data)};\n"
                    f"inline constexpr std::array<std::uint8_t, 32> kVerifierSha256 = {{{as_list(hashlib.sha256(data).digest())}}};\n"
                    "}\n")
    except (OSError, ValueError) as error:
        print(f"signing: {arguments.input}: {error}", file=sys.stderr)
        return 1
    arguments.output.write_text("#pragma once\n" + text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
