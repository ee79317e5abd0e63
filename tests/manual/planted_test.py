#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Violations that the checks of pages and documents must find."""

import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/manual"))

import documents_test
import format_pages
import pages_test

PAGE = ".TH A-B 1\n.TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nHelps.\n.TP\n\\fB\\-\\-old\\fR \\fIFILE\\fR\nGone.\n"


def command(options=(), commands=()):
    return types.SimpleNamespace(words=["a", "b"], options=set(options), commands=list(commands))


class Pages(unittest.TestCase):
    def errors(self, checked, page=PAGE):
        with tempfile.TemporaryDirectory() as folder:
            if page:
                pathlib.Path(folder, "a-b.1").write_text(page)
            return list(pages_test.command_errors(pathlib.Path(folder), 1, checked))

    def test_a_true_page_passes(self):
        self.assertEqual(self.errors(command(["-h", "--help", "--old"])), [])

    def test_a_missing_and_an_invented_option_are_found(self):
        self.assertEqual(len(self.errors(command(["-h", "--help", "--new"]))), 2)

    def test_a_missing_command_and_a_missing_page_are_found(self):
        self.assertEqual(len(self.errors(command(["-h", "--help", "--old"], ["inner"]))), 1)
        self.assertEqual(len(self.errors(command(), page=None)), 1)

    def test_a_lost_word_is_found(self):
        self.assertEqual(pages_test.words_lost("one two three", "zero one two and three"), [])
        self.assertIn("two", pages_test.words_lost("one two", "two one"))


class Documents(unittest.TestCase):
    COMMANDS = {"pharos": command(["--help"], ["track"]), "pharos track": command(["--target"])}

    def test_command_lines_are_found_in_blocks_and_in_text(self):
        text = "Say `pharos track x`.\n```\nsudo pharos track \\\n  y | pharos track - && build/bin/pharos track z # why\n```\n"
        lines = [" ".join(line.split()) for line in documents_test.command_lines(text)]
        self.assertEqual(sorted(lines), ["pharos track -", "pharos track x", "pharos track y", "pharos track z"])

    def test_unknown_commands_and_options_are_found(self):
        self.assertIsNone(documents_test.line_error("pharos track --target t.csv", self.COMMANDS))
        self.assertIn("--targets", documents_test.line_error("pharos track --targets t.csv", self.COMMANDS))
        self.assertIn("trace", documents_test.line_error("pharos trace x", self.COMMANDS))


class Formats(unittest.TestCase):
    def body(self, text):
        return "\n".join(format_pages.tidy(format_pages.page_body(text.splitlines())))

    def test_a_section_ends_at_the_next_heading_of_its_level(self):
        text = "# Top\nfirst\n## A\na\n### B\nb\n```\n## no heading\n```\n## C\nc\n"
        self.assertEqual(format_pages.section(text, "A"), ["a", "### B", "b", "```", "## no heading", "```"])
        self.assertEqual(format_pages.section(text, "Top"), ["first"])
        with self.assertRaises(KeyError):
            format_pages.section(text, "D")

    def test_markdown_becomes_roff(self):
        self.assertEqual(self.body("Say `a-b` and **c**, see [d](e.md)."), "Say \\fBa\\-b\\fR and \\fBc\\fR, see d.")
        self.assertEqual(self.body("```toml\n.x = 'y'\n```"), ".PP\n.nf\n  .x = \\(aqy\\(aq\n.fi\n.PP")
        self.assertIn(".IP \\(bu 2\none two", self.body("- one\n  two"))
        self.assertIn(".TP\n\\fBk\\fR\nwhat; default: 1", self.body("| key | default | meaning |\n|---|---|---|\n| `k` | 1 | what |"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
