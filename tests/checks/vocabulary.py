#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails where a C++ file uses a retired identifier: one for which the field has a standard term (vocabulary.toml)."""

import argparse
import pathlib
import re
import sys
import tomllib

FOLDERS = ("common", "firmware", "host", "tools", "tests")
SUFFIXES = {".hpp", ".cpp", ".h"}
STRINGS = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^()\\ ]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\'', re.S)
WORD = re.compile(r"[A-Za-z_]\w*")


class Vocabulary:
    def __init__(self, file):
        rows = tomllib.loads(file.read_text())["retired"]
        self.rows = [(re.compile(row["pattern"]), row["use"], set(row.get("except", ()))) for row in rows]

    def instead(self, word):
        """The replacement of a retired identifier; None for all others."""
        for pattern, use, kept in self.rows:
            if word not in kept and pattern.fullmatch(word):
                return use
        return None


def code_of(text):
    """The text with comments and literals blanked, line by line as before."""
    return STRINGS.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def violations(root, vocabulary):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in SUFFIXES or not path.is_file():
                continue
            name = path.relative_to(root).as_posix()
            for word in WORD.findall(path.stem):
                if (use := vocabulary.instead(word)) is not None:
                    yield f"{name}:1: file name '{word}' is retired; use {use}"
            for number, line in enumerate(code_of(path.read_text()).splitlines(), 1):
                for word in WORD.findall(line):
                    if (use := vocabulary.instead(word)) is not None:
                        yield f"{name}:{number}: '{word}' is retired; use {use}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    vocabulary = Vocabulary(pathlib.Path(__file__).with_name("vocabulary.toml"))
    found = list(violations(parser.parse_args().root.resolve(), vocabulary))
    for violation in found:
        print(violation)
    print(f"{len(found)} retired identifiers")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
