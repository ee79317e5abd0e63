#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every option and command that a program's --help prints is on its manual page; every word of a README's section is on
the page made of it; every page is rendered without a warning."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

import programs

WORD = re.compile(r"[A-Za-z0-9_]+")
ENVIRONMENT = {**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8", "MAN_KEEP_FORMATTING": ""}


def rendered(page):
    """The page's text and what man warns of."""
    done = subprocess.run(["man", "--warnings", "--encoding=UTF-8", "-P", "cat", "-l", page], capture_output=True, text=True,
                          env=ENVIRONMENT)
    return re.sub(".\x08", "", done.stdout), done.stderr.strip()


def options_on(page):
    """The options for which the page has an entry."""
    text = pathlib.Path(page).read_text().replace("\\-", "-")
    entries = re.findall(r"^\.TP\n(\\fB-.*)$", text, re.MULTILINE)
    return {name for entry in entries for name in re.findall(r"\\fB(-[^\\]+)\\fR", entry)}


def command_errors(man, section, command):
    name = "-".join(command.words)
    page = man / f"{name}.{section}"
    if not page.is_file():
        yield f"{name}: no page"
        return
    for option in sorted(command.options ^ options_on(page)):
        yield f"{page.name}: {option} is {'not on the page' if option in command.options else 'no option'}"
    text = page.read_text().replace("\\-", "-")
    for inner in command.commands:
        if f"{name}-{inner}" not in text:
            yield f"{page.name}: does not name {inner}"


def words_lost(source, page_text):
    """Words of a section that do not follow each other in this order on the page."""
    words = iter(WORD.findall(page_text))
    return [word for word in WORD.findall(source) if word not in words]


def section_errors(root, man, format_pages, entry):
    page = man / f"{entry['name']}.{entry['section']}"
    text = rendered(page)[0]
    for part in entry["part"]:
        lines = format_pages.section((root / part["file"]).read_text(), part["heading"])
        # Without addresses of links, the names of examples' languages, and the order of a table's cells.
        plain = re.sub(r"\]\([^)]*\)", "]", "\n".join(line for line in lines if not line.startswith(("```", "|"))))
        lost = words_lost(plain, text)
        in_table = {word for line in lines if line.startswith("|") for word in WORD.findall(re.sub(r"\]\([^)]*\)", "]", line))}
        lost += sorted(in_table - set(WORD.findall(text)) - header_words(lines))
        if lost:
            yield f"{page.name}: lost of {part['file']}: {' '.join(lost[:10])}"


def header_words(lines):
    """Words of the first and the last column's heads, which a list of terms does not need."""
    heads = [above for above, below in zip(lines, lines[1:]) if re.fullmatch(r"\|[-|]+\|", below)]
    return {word for head in heads for word in WORD.findall(head)}


def main():
    root, build = map(pathlib.Path, sys.argv[1:3])
    if shutil.which("man") is None:
        print("skipped: man-db is not installed (tools/install-dependencies test)")
        sys.exit(programs.SKIPPED)
    sys.path.insert(0, str(root / "tools/manual"))
    import format_pages

    man = build / "manual/man"
    errors = []
    commands = programs.every_command(build)
    for section, command in commands:
        errors += command_errors(man, section, command)
    for entry in tomllib.loads((root / "tools/manual/pages.toml").read_text())["page"]:
        errors += section_errors(root, man, format_pages, entry)
    pages = sorted(man.iterdir())
    for page in [*pages, root / "host/packaging/pharos-example-subscriber.1"]:
        if warnings := rendered(page)[1]:
            errors.append(f"{page.name}: {warnings}")
    named = set(re.findall(r"[a-z.-]+\([1578]\)", " ".join(page.read_text().replace("\\-", "-") for page in pages)))
    there = {f"{page.stem}({page.suffix[1:]})" for page in pages}
    errors += [f"{name} is named and does not exist" for name in sorted(named - there) if name.startswith("pharos")]
    options = sum(len(command.options) for _, command in commands)
    programs.finish(errors, f"{options} options of {len(commands)} commands, {len(pages)} pages")


if __name__ == "__main__":
    main()
