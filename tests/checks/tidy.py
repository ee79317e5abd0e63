#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: tidy.py COMPILE_COMMANDS PASSED_DIR JOBS REGEX

clang-tidy 14 over every file of compile_commands.json whose path matches REGEX; prints the findings, exit 1 if any.
A file that passed is remembered in PASSED_DIR by what the compiler reads of it (its preprocessed text with comments, its
flags, .clang-tidy): a second run costs the preprocessor alone, so that after mending only what changed is looked at again.
"""
import concurrent.futures
import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys

TIDY = "clang-tidy-14"
NOISE = re.compile(r"warnings? generated|warnings? and .* generated|^Suppressed |^Use -header-filter|^$")


def flags_without_output(entry):
    words = shlex.split(entry["command"])
    at = words.index("-o")
    return [word for word in words[:at] + words[at + 2:] if word != "-c"]


def fingerprint(entry, rules):
    """None where the preprocessor fails: clang-tidy will report why."""
    command = flags_without_output(entry)
    text = subprocess.run(command + ["-E", "-C"], cwd=entry["directory"], capture_output=True)
    if text.returncode != 0:
        return None
    return hashlib.sha256(b"\0".join([rules, " ".join(command).encode(), text.stdout])).hexdigest()


def look_at(entry, commands, passed, rules):
    mark = fingerprint(entry, rules)
    if mark and (passed / mark).exists():
        return ""
    run = subprocess.run([TIDY, "-quiet", "-p", str(pathlib.Path(commands).parent), entry["file"]], capture_output=True, text=True)
    if run.returncode == 0:
        if mark:
            (passed / mark).touch()
        return ""
    lines = (run.stdout + run.stderr).splitlines()
    findings = [line for line in lines if not NOISE.search(line)]
    return "\n".join(findings) or f"{entry['file']}: {TIDY} ended with {run.returncode}"


def main():
    commands, passed, jobs, pattern = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), re.compile(sys.argv[4])
    passed.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([TIDY, "--version"], capture_output=True, check=True).stdout
    root = pathlib.Path(__file__).resolve().parents[2]
    rules = version + b"".join((root / folder / ".clang-tidy").read_bytes() for folder in (".", "tests"))
    entries = [entry for entry in json.loads(pathlib.Path(commands).read_text()) if pattern.search(entry["file"])]
    if not entries:
        sys.exit(f"tidy.py: no file matches {pattern.pattern}")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        looks = [pool.submit(look_at, entry, commands, passed, rules) for entry in entries]
        failures = 0
        for done in concurrent.futures.as_completed(looks):
            if done.result():
                failures += 1
                print(done.result(), flush=True)
    print(f"clang-tidy: {len(entries)} files, {failures} with findings")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
