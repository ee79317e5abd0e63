#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
import gzip
import tempfile
import unittest

import examples
import numpy as np
import pharos

POSES = """time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m,status,flags,station_id
1.5,0,1,0,0,0,0.1,0.2,2.5,ok,,12345678
1.6,0,,,,,,,,refused_too_few,flash_weak,12345678
1.7,0,0.7071067811865476,0,0,0.7071067811865476,0,0,3,ok,prior|fused,BEC08E38
"""


class Tables(unittest.TestCase):
    def read(self, text, reader=pharos.read_table):
        data = text if isinstance(text, bytes) else text.encode()
        with tempfile.NamedTemporaryFile() as file:
            file.write(data)
            file.flush()
            return reader(file.name)

    def test_numbers_words_and_empty_fields(self):
        table = self.read(POSES)
        self.assertEqual(list(table)[:3], ["time_s", "station", "qw"])
        np.testing.assert_array_equal(table["tz_m"], [2.5, np.nan, 3.0])
        self.assertEqual(table["status"].tolist(), ["ok", "refused_too_few", "ok"])
        self.assertEqual(table["station_id"].tolist(), ["12345678", "12345678", "BEC08E38"])
        self.assertEqual(table["flags"][0], "")

    def test_gzip_is_recognised_by_content(self):
        np.testing.assert_array_equal(self.read(gzip.compress(POSES.encode()))["time_s"], [1.5, 1.6, 1.7])

    def test_ticks_keep_every_digit(self):
        ticks = 2**60 + 1
        table = self.read(f"sensor,rise_ticks,fall_ticks\n3,{ticks},{ticks + 200}\n")
        self.assertEqual(table["rise_ticks"].dtype, np.int64)
        self.assertEqual(int(table["rise_ticks"][0]), ticks)

    def test_poses_become_matrices(self):
        rotations, positions = pharos.pose_arrays(self.read(POSES))
        np.testing.assert_allclose(rotations[0], np.eye(3))
        self.assertTrue(np.isnan(rotations[1]).all() and np.isnan(positions[1]).all())
        np.testing.assert_allclose(rotations[2] @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], atol=1e-15)
        np.testing.assert_array_equal(positions[2], [0.0, 0.0, 3.0])

    def test_any_quaternion_gives_a_rotation(self):
        quaternions = np.random.default_rng(1).normal(size=(100, 4))
        R = pharos.rotation_matrices(quaternions)
        np.testing.assert_allclose(R @ np.swapaxes(R, 1, 2), np.broadcast_to(np.eye(3), R.shape), atol=1e-12)
        np.testing.assert_allclose(np.linalg.det(R), 1.0)

    def test_a_cut_off_last_line_is_left_out(self):
        self.assertEqual(len(self.read("a,b\n1,2\n3")["a"]), 1)
        self.assertEqual(len(self.read("a,b\n1,2\n3,4")["a"]), 2)

    def test_a_table_without_rows_has_its_columns(self):
        self.assertEqual({name: len(column) for name, column in self.read("a,b\n").items()}, {"a": 0, "b": 0})

    def test_what_is_no_table_is_refused_with_its_place(self):
        for text, place in (("", "header"), ("a,b\n1,2,3\n4,5\n", ":2:"), ("a,a\n1,2\n", "twice"), ("x_m\n1\nword\n", "x_m")):
            with self.assertRaisesRegex(ValueError, place):
                self.read(text)

    def test_a_trajectory_has_the_same_columns(self):
        table = self.read("# comment\n1.0 0.1 0.2 0.3 0 0 0 1\n", pharos.read_tum)
        self.assertEqual((table["tz_m"][0], table["qw"][0]), (0.3, 1.0))

    def test_a_covariance_is_a_matrix(self):
        matrix = pharos.covariance_matrix(examples.pose())
        self.assertEqual(matrix[2, 3], 15.0)


if __name__ == "__main__":
    unittest.main()
