#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
import pathlib
import random
import unittest

import examples
import pharos


class Messages(unittest.TestCase):
    def test_every_type_of_proto_is_there(self):
        proto = pathlib.Path(__file__).resolve().parents[2] / "proto"
        self.assertEqual(set(pharos.TYPES), {file.stem for file in proto.glob("*.lcm")})
        for name, kind in pharos.TYPES.items():
            self.assertIs(getattr(pharos, name), kind)

    def test_every_type_is_recognised_and_reads_back_equal(self):
        for message in examples.every_type():
            decoded = pharos.decode(message.encode())
            self.assertIs(type(decoded), type(message))
            self.assertEqual(examples.fields(decoded), examples.fields(message))

    def test_cut_off_longer_or_foreign_bytes_are_refused(self):
        for message in examples.every_type():
            data = message.encode()
            for length in range(len(data)):
                with self.assertRaises(ValueError):
                    pharos.decode(data[:length])
            with self.assertRaises(ValueError):
                pharos.decode(data + b"\0")
        with self.assertRaises(ValueError):
            pharos.decode(bytes(1000))

    def test_values_that_no_pharosd_sends_are_refused(self):
        nan, inf = float("nan"), float("inf")
        negative = [0.0] * 36
        negative[14] = -1e-9
        for changes in ({"position_m": [0.0, nan, 1.0]}, {"position_m": [inf, 0.0, 1.0]}, {"position_m": [0.0, 0.0, 1e30]},
                        {"orientation_wxyz": [0.0] * 4}, {"orientation_wxyz": [1.0, 0.0, 0.0, 0.1]}, {"covariance": negative},
                        {"covariance": [nan] * 36}, {"sigma_pos_m": nan}, {"utime": -1}, {"has_second": True}):
            with self.assertRaisesRegex(ValueError, "impossible"):
                pharos.decode(examples.pose(**changes).encode())
        refused = examples.pose(valid=False, orientation_wxyz=[0.0] * 4)
        self.assertFalse(pharos.decode(refused.encode()).valid)

    def test_any_change_of_bytes_is_a_message_or_refused(self):
        chance = random.Random("any_change_of_bytes")
        for message in examples.every_type():
            for _ in range(300):
                data = bytearray(message.encode())
                for _ in range(chance.randint(1, 8)):
                    data[chance.randrange(len(data))] = chance.randrange(256)
                try:
                    pharos.decode(bytes(data))
                except ValueError:
                    pass


class Steering(unittest.TestCase):
    NOW_S = 1_700_000_000.2

    def for_steering(self, **changes):
        return pharos.for_steering(examples.pose(**changes), 0.5, now_s=self.NOW_S)

    def test_a_fresh_pose_without_doubts_steers(self):
        self.assertTrue(self.for_steering())

    def test_each_doubt_alone_forbids_it(self):
        self.assertFalse(self.for_steering(valid=False))
        self.assertFalse(self.for_steering(status="ambiguous"))
        self.assertFalse(self.for_steering(utime=1_699_999_999_000_000))
        self.assertFalse(self.for_steering(utime=1_700_000_001_000_000))
        for word in pharos.NOT_FOR_STEERING:
            self.assertFalse(self.for_steering(flags=f"prior|{word}"))

    def test_flags_are_words(self):
        self.assertEqual(pharos.flag_words(examples.pose()), {"prior", "fused"})
        self.assertEqual(pharos.flag_words(examples.pose(flags="")), frozenset())
        self.assertTrue(self.for_steering(flags="not_uncalibrated_really"))


if __name__ == "__main__":
    unittest.main()
