#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: tidy.py ROOT COMPILE_COMMANDS WORK_DIR JOBS REGEX

clang-tidy 14 over every file of compile_commands.json whose path matches REGEX; prints the findings, exit 1 if any.
Nine tenths of its time are headers (Eigen, GoogleTest, OpenCV), so the files of a target that are compiled alike are looked
at as one: their texts one after another in WORK_DIR/together, not a file that includes them, because several checks and
the analyser look at the main file only. Eight files cost what one did (11 s for 10). An include that is missing in a file
whose neighbour has it is not found: the preset `dev` finds it.
What passed is remembered in WORK_DIR/passed by what the compiler reads (preprocessed text with comments, flags,
.clang-tidy): a second run costs the preprocessor alone, so that after mending only what changed is looked at again.
"""
import bisect
import concurrent.futures
import hashlib
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
from typing import NamedTuple

TIDY = "clang-tidy-14"
NOISE = re.compile(r"warnings? generated|warnings? and .* generated|^Suppressed |^Use -header-filter|^$")
INCLUDE = re.compile(r'\s*#\s*include\s*([<"][^>"]+[>"])')
MAX_FILES = 8  # as in a unity build, which shows that names do not clash


class Text(NamedTuple):
    """The files of one target, as one."""

    path: pathlib.Path
    flags: list  # of the compiler, without input and output
    folder: str  # in which the compiler runs
    sources: list
    starts: list  # first line of each source, from 1


def flags_of(entry):
    words = shlex.split(entry["command"])
    at = words.index("-o")
    return [word for word in words[:at] + words[at + 2 :] if word not in ("-c", entry["file"])]


def targets(entries):
    """Lists of entries with one target and the same flags."""
    groups = {}
    for entry in entries:
        target = re.search(r" -o (\S+)\.dir/", entry["command"])[1]
        groups.setdefault((target, tuple(flags_of(entry))), []).append(entry)
    for (target, _), group in groups.items():
        for first in range(0, len(group), MAX_FILES):
            yield target, group[first : first + MAX_FILES]


def write_together(root, work, target, number, group):
    """An include that an earlier file has is left out: readability-duplicate-include sees one file."""
    lines, starts, seen = [], [], set()
    for entry in group:
        starts.append(len(lines) + 1)
        own = set()
        for line in pathlib.Path(entry["file"]).read_text().splitlines():
            name = INCLUDE.match(line)
            if name:
                again = name[1] in seen and name[1] not in own
                own.add(name[1])
                line = "" if again else line
            lines.append(line)
        seen |= own
    folder = pathlib.Path(group[0]["file"]).parent
    folder = work / "together" / (folder.relative_to(root) if folder.is_relative_to(root) else "elsewhere")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{pathlib.Path(target).name}_{number}.cpp"
    path.write_text("\n".join(lines) + "\n")
    beside = [word for place in dict.fromkeys(str(pathlib.Path(e["file"]).parent) for e in group) for word in ("-iquote", place)]
    return Text(path, flags_of(group[0]) + beside, group[0]["directory"], [e["file"] for e in group], starts)


def fingerprint(text, rules):
    """None where the preprocessor fails: clang-tidy will report why."""
    run = subprocess.run(text.flags + ["-E", "-C", str(text.path)], cwd=text.folder, capture_output=True)
    if run.returncode != 0:
        return None
    return hashlib.sha256(b"\0".join([rules, " ".join(text.flags).encode(), run.stdout])).hexdigest()


def in_its_source(text, line):
    """A finding with the place in its source instead of that in the text."""

    def place(match):
        number = int(match[1])
        at = bisect.bisect(text.starts, number) - 1
        return f"{text.sources[at]}:{number - text.starts[at] + 1}:"

    return re.sub(re.escape(str(text.path)) + r":(\d+):", place, line)


def look_at(text, passed, rules):
    mark = fingerprint(text, rules)
    if mark and (passed / mark).exists():
        return ""
    run = subprocess.run([TIDY, "-quiet", str(text.path), "--", *text.flags[1:]], cwd=text.folder, capture_output=True, text=True)
    if run.returncode == 0:
        if mark:
            (passed / mark).touch()
        return ""
    lines = (run.stdout + run.stderr).splitlines()
    findings = [in_its_source(text, line) for line in lines if not NOISE.search(line)]
    return "\n".join(findings) or f"{', '.join(text.sources)}: {TIDY} ended with {run.returncode}"


def main():
    root, commands, work = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    jobs, pattern = int(sys.argv[4]), re.compile(sys.argv[5])
    passed = work / "passed"
    passed.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(work / "together", ignore_errors=True)
    rules = subprocess.run([TIDY, "--version"], capture_output=True, check=True).stdout
    for folder in (".", "tests"):
        (work / "together" / folder).mkdir(parents=True, exist_ok=True)
        shutil.copy(root / folder / ".clang-tidy", work / "together" / folder)
        rules += (root / folder / ".clang-tidy").read_bytes()
    entries = [entry for entry in json.loads(commands.read_text()) if pattern.search(entry["file"])]
    if not entries:
        sys.exit(f"tidy.py: no file matches {pattern.pattern}")
    texts = [write_together(root, work, target, i, group) for i, (target, group) in enumerate(targets(entries))]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        looks = [pool.submit(look_at, text, passed, rules) for text in texts]
        failures = 0
        for done in concurrent.futures.as_completed(looks):
            if done.result():
                failures += 1
                print(done.result(), flush=True)
    print(f"clang-tidy: {len(entries)} files in {len(texts)} texts, {failures} with findings")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
