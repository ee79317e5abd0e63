#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Debian recipe asks for the packages that tools/install-dependencies installs for the programs and the firmware.
That every installed file is in a package, and every package's file installed, debhelper checks itself (dh_missing)."""

import pathlib
import re
import sys

# Part of every Debian build, or of the packaging alone.
BUILD_ESSENTIAL = {"g++"}
PACKAGING = {"debhelper-compat", "dh-python"}


def names(text):
    lines = (line.split("#")[0] for line in text.splitlines())
    return {word for line in lines for word in line.split()}


def wanted(script):
    text = script.read_text()
    arrays = {name: names(body) for name, body in re.findall(r"^(\w+)_packages=\(\n(.*?)^\)", text, re.MULTILINE | re.DOTALL)}
    return arrays["build"] | arrays["firmware"]


def asked(control):
    body = re.search(r"^Build-Depends:\n((?: .*\n)+)", control.read_text(), re.MULTILINE)[1]
    return {re.sub(r" *\(.*\)", "", item.strip()) for item in body.split(",")}


def main():
    root = pathlib.Path(sys.argv[1])
    difference = (wanted(root / "tools/install-dependencies") - BUILD_ESSENTIAL) ^ (asked(root / "cmake/debian/control") - PACKAGING)
    if difference:
        sys.exit(f"only one of tools/install-dependencies and cmake/debian/control has: {' '.join(sorted(difference))}")
    print(f"{len(asked(root / 'cmake/debian/control'))} build dependencies")


if __name__ == "__main__":
    main()
