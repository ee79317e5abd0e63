#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Command lines in the documents name commands and options that exist; SUBSCRIBER.md explains every field of the
messages and every flag."""

import pathlib
import re
import sys
import tomllib

import programs

DOCUMENTS = ("README.md", "OPERATOR.md", "SUBSCRIBER.md", "RESULTS.md", "tools/README.md", "tools/manual/README.md",
             "host/README.md", "host/example/README.md")
FENCE = re.compile(r"^```[a-z]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"`([^`\n]+)`")
LINE = re.compile(r"(?:^|[|;&(] *|sudo |bin/)(pharosd?(?: [^|;&#\n`)]*)?)", re.MULTILINE)
FIELD = re.compile(r"^\s+(?:[a-z0-9_]+) ([a-z0-9_]+)(?:\[[^\]]*\])*;", re.MULTILINE)
FLAG_TABLE = re.compile(r"FlagWord, \d+> k\w+(?: = )?\{+(.*?)\}\};", re.DOTALL)
FLAG_ADDED = re.compile(r"(?:add_flag_word\(\w+(?:\.\w+)?, |Word = )\"([a-z_]+)\"")
FLAG_PLACES = ("common/pharos/track/epoch_tracker.hpp", "common/pharos/tof/tof_pose.hpp", "host/daemon", "host/publish/words.hpp")


def command_lines(text):
    for block in FENCE.findall(text):
        yield from LINE.findall(block.replace("\\\n", " "))
    for code in INLINE.findall(FENCE.sub("", text)):
        if code.startswith(("pharos ", "pharosd ")):
            yield from LINE.findall(code)


def line_error(line, commands):
    words = line.split()
    known = [words[0]]
    for word in words[1:]:
        if " ".join([*known, word]) not in commands:
            break
        known.append(word)
    command = commands[" ".join(known)]
    rest = words[len(known):]
    if command.commands and rest and not rest[0].startswith("-") and re.fullmatch(r"[a-z]+", rest[0]):
        return f"{rest[0]} is no command"
    unknown = [word for word in rest if word.startswith("--") and word.split("=")[0].rstrip(",.:") not in command.options]
    return f"{' '.join(unknown)} is no option" if unknown else None


def document_errors(root, commands):
    for name in DOCUMENTS:
        for line in command_lines((root / name).read_text()):
            checked.append(line)
            if error := line_error(line, commands):
                yield f"{name}: `{line.strip()}`: {error}"


def keys_of(table, above=""):
    """`target[].name` and the like of a configuration."""
    for key, value in table.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            for inner in value:
                yield from keys_of(inner, f"{above}{key}[].")
        elif isinstance(value, dict):
            yield from keys_of(value, f"{above}{key}.")
        else:
            yield above + key


def configuration_errors(root):
    """Configurations in OPERATOR.md have keys that host/README.md's table has."""
    table = (root / "host/README.md").read_text().split("## Configuration")[1]
    for text in re.findall(r"^```toml\n(.*?)^```$", (root / "OPERATOR.md").read_text(), re.MULTILINE | re.DOTALL):
        for key in keys_of(tomllib.loads(text)):
            checked.append(key)
            if f"`{key}`" not in table:
                yield f"OPERATOR.md: {key} is no key of the configuration"


def flag_words(root):
    for place in FLAG_PLACES:
        path = root / place
        for file in [path] if path.is_file() else sorted(path.rglob("*.cpp")):
            text = file.read_text()
            for table in FLAG_TABLE.findall(text):
                yield from re.findall(r'"([a-z_]+)"', table)
            yield from FLAG_ADDED.findall(text)


def subscriber_errors(root):
    text = (root / "SUBSCRIBER.md").read_text()
    explained = set(INLINE.findall(text))
    for types in sorted((root / "proto").glob("*.lcm")):
        for field in FIELD.findall(types.read_text()):
            checked.append(field)
            if field not in explained:
                yield f"SUBSCRIBER.md: {types.stem}.{field} is not explained"
    flags = {word for row in re.findall(r"^\| (`[a-z_]+`(?:, `[a-z_]+`)*) \|", text.split("## What to do with flags")[1], re.MULTILINE)
             for word in INLINE.findall(row)}
    in_code = set(flag_words(root))
    for word in sorted(flags ^ in_code):
        yield f"SUBSCRIBER.md: the flag {word} is {'not explained' if word in in_code else 'of no message'}"
    checked.extend(in_code)


checked = []


def main():
    root, build = map(pathlib.Path, sys.argv[1:3])
    commands = {" ".join(command.words): command for _, command in programs.every_command(build)}
    errors = [*document_errors(root, commands), *configuration_errors(root), *subscriber_errors(root)]
    programs.finish(errors, f"{len(checked)} command lines, keys, fields and flags")


if __name__ == "__main__":
    main()
