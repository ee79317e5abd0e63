# SPDX-License-Identifier: Apache-2.0
"""The built programs as a user sees them: what their --help says."""

import concurrent.futures
import pathlib
import re
import subprocess
import sys

SKIPPED = 77
OPTION = re.compile(r"^  (?P<names>-[^ ]+)(?= |$)")
COMMAND = re.compile(r"^  (?P<name>[a-z][a-z0-9-]*)(?: {2,}|$)")


class Command:
    """One command: its words, and the options and subcommands that --help prints."""

    def __init__(self, program, words):
        self.words = words
        self.help = subprocess.run([program, *words[1:], "--help"], capture_output=True, text=True, check=True).stdout
        self.options, self.commands = set(), []
        part = ""
        for line in self.help.splitlines():
            if line and not line.startswith(" "):
                part = line
            if part in ("Options:", "Positionals:") and (match := OPTION.match(line)):
                self.options |= {name.split("{")[0] for name in match["names"].split(",")}
            elif part == "Subcommands:" and (match := COMMAND.match(line)):
                self.commands.append(match["name"])


def commands_of(program, words):
    """The command and all below it."""
    command = Command(program, words)
    found = [command]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for below in pool.map(lambda name: commands_of(program, [*words, name]), command.commands):
            found += below
    return found


def every_command(build):
    """(section of the manual, Command) of every command of every program."""
    programs = pathlib.Path(build) / "bin"
    return ([(1, command) for command in commands_of(programs / "pharos", ["pharos"])] +
            [(8, command) for name in ("pharosd", "pharos-camera") for command in commands_of(programs / name, [name])])


def finish(errors, checked):
    for error in errors:
        print(error)
    print(f"{checked}, {len(errors)} errors")
    if checked.startswith("0 "):
        sys.exit("nothing was checked")
    sys.exit(1 if errors else 0)
