#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compare.py finds every planted difference, and none where there is none."""

import struct
import unittest

from compare import compare


def x(value):
    return "x" + struct.pack(">d", value).hex()


LINES = [
    "sweep 51250130 3657 0 1",
    "frame b0102a0ff",
    f"smoothed {x(0.25)} {x(833334.0)}",
    f"pose {x(1.0)} {x(-0.5)} {x(3.0)}",
    f"covariance {x(4e-6)} {x(1e-9)}",
]


class Compare(unittest.TestCase):
    def complaints(self, number, line):
        lines = list(LINES)
        lines[number] = line
        return compare(LINES, lines)[0]

    def test_equal_results_pass(self):
        self.assertEqual(compare(LINES, list(LINES))[0], [])

    def test_an_integer_off_by_one_is_found(self):
        self.assertEqual(len(self.complaints(0, "sweep 51250131 3657 0 1")), 1)

    def test_a_flipped_bit_of_a_frame_is_found(self):
        self.assertEqual(len(self.complaints(1, "frame b0102a0fe")), 1)

    def test_a_missing_value_is_found(self):
        self.assertEqual(len(self.complaints(0, "sweep 51250130 3657 0")), 1)

    def test_another_key_is_found(self):
        self.assertEqual(len(self.complaints(0, "payload 51250130 3657 0 1")), 1)

    def test_the_last_bit_of_a_real_without_bound_is_found(self):
        self.assertEqual(len(self.complaints(2, f"smoothed {x(0.25)} {x(833334.0000000001)}")), 1)

    def test_zeros_of_different_sign_are_told_apart_where_bits_count(self):
        lines = [f"smoothed {x(0.0)}"]
        self.assertEqual(len(compare(lines, [f"smoothed {x(-0.0)}"])[0]), 1)

    def test_a_real_within_its_bound_passes(self):
        self.assertEqual(self.complaints(3, f"pose {x(1.0 + 1e-14)} {x(-0.5)} {x(3.0)}"), [])

    def test_a_real_beyond_its_bound_is_found(self):
        self.assertEqual(len(self.complaints(3, f"pose {x(1.0 + 1e-9)} {x(-0.5)} {x(3.0)}")), 1)

    def test_a_relative_bound_is_of_the_largest_value_of_the_line(self):
        self.assertEqual(self.complaints(4, f"covariance {x(4e-6)} {x(1.000001e-9)}"), [])
        self.assertEqual(len(self.complaints(4, f"covariance {x(4.00001e-6)} {x(1e-9)}")), 1)

    def test_nan_is_found(self):
        self.assertEqual(len(self.complaints(3, f"pose {x(float('nan'))} {x(-0.5)} {x(3.0)}")), 1)

    def test_lines_too_few_too_many_or_none_are_found(self):
        self.assertEqual(len(compare(LINES, LINES[:-1])[0]), 1)
        self.assertEqual(len(compare(LINES[:-1], LINES)[0]), 1)
        self.assertTrue(compare([], [])[0])


if __name__ == "__main__":
    unittest.main()
