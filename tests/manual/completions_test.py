#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bash and zsh complete every subcommand and option that a program's --help prints, and the values of options that have
a few."""

import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

import programs

# Lines of words, the last one to be completed, separated by tabs -> what bash offers, separated by spaces.
BASH = r"""
source "$1"
while IFS=$'\t' read -r -a COMP_WORDS; do
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  [[ ${COMP_WORDS[COMP_CWORD]} == EMPTY ]] && COMP_WORDS[COMP_CWORD]=
  "_$2_complete"
  echo "${COMPREPLY[*]}"
done
"""
PROMPT = b"ready>"


def bash_offers(script, program, lines):
    done = subprocess.run(["bash", "--norc", "--noprofile", "-c", BASH, "bash", script, program], text=True, check=True,
                          capture_output=True, input="".join("\t".join(line) + "\n" for line in lines))
    if done.stderr:
        raise RuntimeError(done.stderr)
    return [set(answer.split()) for answer in done.stdout.splitlines()]


def bash_errors(folder, commands):
    for program in ("pharos", "pharosd"):
        own = [command for _, command in commands if command.words[0] == program]
        script = folder / program
        for command, offered in zip(own, bash_offers(script, program, [[*command.words, "-"] for command in own])):
            if offered != command.options:
                yield f"bash: {' '.join(command.words)} -: offered {sorted(offered ^ command.options)} wrongly or not"
        above = [command for command in own if command.commands]
        for command, offered in zip(above, bash_offers(script, program, [[*command.words, "EMPTY"] for command in above])):
            if offered != set(command.commands):
                yield f"bash: {' '.join(command.words)}: {sorted(offered)}"
    cases = {("pharos", "track", "--method", "m"): {"motion"}, ("pharos", "track", "--target", "EMPTY"): set(),
             ("pharos", "slam", "--scene", "EMPTY"): {"auto", "target", "static"}, ("pharos", "tr"): {"track"},
             ("pharos", "sim", "li"): {"lighthouse", "line"}, ("pharos", "track", "--target", "file", "--s"):
             {option for _, command in commands if command.words == ["pharos", "track"] for option in command.options
              if option.startswith("--s")}}
    for words, offered in zip(cases, bash_offers(folder / "pharos", "pharos", [list(words) for words in cases])):
        if offered != cases[words]:
            yield f"bash: {' '.join(words)}: {sorted(offered)}, not {sorted(cases[words])}"


class Zsh:
    """An interactive zsh with these completions alone."""

    def __init__(self, folder):
        self.home = tempfile.TemporaryDirectory()
        process, self.terminal = pty.fork()
        if process == 0:
            os.environ.update(HOME=self.home.name, TERM="dumb", LC_ALL="C.UTF-8", COLUMNS="200", LINES="100")
            os.execlp("zsh", "zsh", "-f", "-i")
        self.ask(f"PS1='{PROMPT.decode()[:-1]}''>'; fpath=({folder} $fpath); autoload -U compinit; compinit -u -D; "
                 "LISTMAX=0; unsetopt beep\n", PROMPT)

    def ask(self, keys, until, seconds=20.0):
        os.write(self.terminal, keys.encode())
        return self.read(until, seconds)

    def read(self, until, seconds):
        text, end = b"", time.monotonic() + seconds
        while until not in text and time.monotonic() < end:
            if select.select([self.terminal], [], [], 0.1)[0]:
                text += os.read(self.terminal, 65536)
        return re.sub(rb"\x1b\[[0-9;?]*[A-Za-z]", b"", text).decode("utf-8", "replace")

    def close(self):
        os.write(self.terminal, b"\x03exit\n")
        os.close(self.terminal)


def zsh_errors(folder):
    for script in folder.iterdir():
        done = subprocess.run(["zsh", "-n", script], capture_output=True, text=True)
        if done.returncode != 0:
            yield f"zsh: {script.name}: {done.stderr}"
            return
    shell = Zsh(folder)
    # What is unique is completed in place, and there a listing would be.
    cases = {"pharos trac\t": "track ", "pharos track --metho\t": "--method", "pharos track --method mot\t": "motion",
             "pharos sim lighth\t": "lighthouse", "pharosd --chec\t": "--check", "pharos slam --scene sta\t": "static"}
    for keys, expected in cases.items():
        shown = shell.ask(keys, expected.encode())
        if expected not in shown:
            yield f"zsh: {keys!r} showed {shown!r}"
        shell.ask("\x15\n", PROMPT)
    shell.close()


def main():
    _, build = map(pathlib.Path, sys.argv[1:3])
    commands = programs.every_command(build)
    errors = list(bash_errors(build / "manual/bash", commands))
    with_zsh = shutil.which("zsh") is not None
    if with_zsh:
        errors += zsh_errors(build / "manual/zsh")
    shells = "bash and zsh" if with_zsh else "bash (zsh is not installed: tools/install-dependencies test)"
    programs.finish(errors, f"{len(commands)} commands in {shells}")


if __name__ == "__main__":
    main()
