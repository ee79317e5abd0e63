#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the manual pages of the file formats, of LCM's messages and of the serial line from the sections of the READMEs
that define them (pages.toml), so that there is one text of each."""

import argparse
import pathlib
import re
import sys
import tomllib

HEADING = re.compile(r"^(#+) +(.*)$")
ITEM = re.compile(r"(?P<mark>-|[0-9]+\.) +(?P<text>.*)")
ROFF = {"\\": r"\(rs", "-": r"\-", "'": r"\(aq", "`": r"\(ga", "^": r"\(ha", "~": r"\(ti"}
INLINE = re.compile(r"`(?P<code>[^`]+)`|\*\*(?P<bold>[^*]+)\*\*|\[(?P<link>[^\]]+)\]\([^)]*\)")


def section(text, title):
    """The lines below the heading `title`, with its subsections; of a document's title only up to the first heading."""
    lines, found, level, fenced = [], False, 0, False
    for line in text.splitlines():
        fenced ^= line.startswith("```")
        heading = None if fenced else HEADING.match(line)
        if found and heading and (len(heading[1]) <= level or level == 1):
            break
        if found:
            lines.append(line)
        elif heading and heading[2] == title:
            found, level = True, len(heading[1])
    if not found:
        raise KeyError(f"no heading '{title}'")
    return lines


def roff(text):
    out = "".join(ROFF.get(letter, letter) for letter in text)
    return re.sub(r",(?=[^ ])", r",\\:", out)  # lists of columns are longer than a line


def inline(text):
    parts, at = [], 0
    for match in INLINE.finditer(text):
        parts.append(roff(text[at:match.start()]))
        kept = match["code"] or match["bold"]
        parts.append(f"\\fB{roff(kept)}\\fR" if kept else inline(match["link"]))
        at = match.end()
    parts.append(roff(text[at:]))
    return "".join(parts)


def text_line(text):
    """A line of running text; one that begins with a full stop would be a request."""
    return "\\&" + text if text.startswith(".") else text


def cells(line):
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip()[1:-1])]


def row(header, values):
    """The first cell is the term; the last one says what it is; those between are named by their columns."""
    named = [f"{inline(name)}: {inline(value)}" for name, value in zip(header[1:-1], values[1:-1]) if value]
    text = [inline(values[-1])] if len(values) > 1 and values[-1] else []
    return [".TP", text_line(inline(values[0])) or "\\&", text_line("; ".join(text + named)) or "\\&"]


def table(lines):
    rows = [cells(line) for line in lines]
    header = rows[0]
    # Two tables beside each other: a column without a name between them.
    gap = next((i for i in range(1, len(header) - 1) if not header[i]), len(header))
    out = []
    for start, end in ((0, gap), (gap + 1, len(header))):
        if start >= end:
            continue
        part = [values[start:end] for values in rows[2:] if any(values[start:end])]
        if start or gap < len(header):
            out += [".PP", f"\\fI{inline(header[start])}\\fR:"]
        for values in part:
            out += row(header[start:end], values)
    return out + [".PP"]


def page_body(lines):
    out, paragraph, i = [], [], 0

    def flush():
        if paragraph:
            out.append(text_line(inline(" ".join(paragraph))))
            paragraph.clear()

    while i < len(lines):
        line = lines[i]
        if line.startswith("```"):
            flush()
            end = next(k for k in range(i + 1, len(lines)) if lines[k].startswith("```"))
            out.extend([".PP", ".nf", *("  " + roff(code) if code else "" for code in lines[i + 1:end]), ".fi", ".PP"])
            i = end
        elif line.startswith("|"):
            flush()
            end = next((k for k in range(i, len(lines)) if not lines[k].startswith("|")), len(lines))
            out.extend(table(lines[i:end]))
            i = end - 1
        elif HEADING.match(line):
            flush()
            out.append(f".SS {roff(HEADING.match(line)[2])}")
        elif item := ITEM.match(line):
            flush()
            out.append(".IP \\(bu 2" if item["mark"] == "-" else f".IP {item['mark']} 4")
            paragraph.append(item["text"])
        elif not line.strip():
            flush()
            out.append(".PP")
        else:
            paragraph.append(line.strip())
        i += 1
    flush()
    return out


def tidy(lines):
    """Without paragraphs that follow each other and empty lines outside examples."""
    out, example = [], False
    for line in lines:
        example = line == ".nf" or (example and line != ".fi")
        if line == ".PP" and out and (out[-1] == ".PP" or out[-1].startswith(".S")):
            continue
        out.append(line)
    return out


def page(root, entry, version):
    name, number = entry["name"], entry["section"]
    out = ['.\\" Made from the READMEs (tools/manual/format_pages.py).',
           f'.TH {name.upper()} {number} "" "Pharos {version}" "Pharos"', ".ad l", ".nh",
           ".SH NAME", f"{roff(name)} \\- {roff(entry['title'])}"]
    for part in entry["part"]:
        out.append(f".SH {roff(part['as'].upper())}")
        out += page_body(section((root / part["file"]).read_text(), part["heading"]))
    out += [".SH SEE ALSO", roff(", ".join(entry["see_also"]))]
    return "\n".join(tidy(out)) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--version", required=True)
    arguments = parser.parse_args()
    pages = tomllib.loads(pathlib.Path(__file__).with_name("pages.toml").read_text())["page"]
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for entry in pages:
        try:
            text = page(arguments.root, entry, arguments.version)
        except KeyError as error:
            sys.exit(f"pages.toml: {entry['name']}: {error.args[0]}")
        (arguments.folder / f"{entry['name']}.{entry['section']}").write_text(text)


if __name__ == "__main__":
    main()
