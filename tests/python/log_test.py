#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
import collections
import os
import random
import struct
import tempfile
import unittest

import examples
import pharos


def event(number, channel, data):
    head = struct.pack(">IqqII", 0xEDA1DA01, number, 1_000_000 * number, len(channel), len(data))
    return head + channel.encode() + data


class Log(unittest.TestCase):
    def setUp(self):
        self.file = tempfile.NamedTemporaryFile(suffix=".lcm")
        self.addCleanup(self.file.close)

    def read(self, data, channels=None):
        with open(self.file.name, "wb") as file:
            file.write(data)
        skipped = collections.Counter()
        messages = list(pharos.read_log(self.file.name, channels, skipped))
        return messages, skipped

    @staticmethod
    def poses(count):
        return [event(k, "PHAROS_LIGHTHOUSE_POSE", examples.pose(k).encode()) for k in range(count)]

    def test_events_come_in_order_with_their_times(self):
        messages, skipped = self.read(b"".join(self.poses(300)))
        self.assertEqual([message.message.sequence for message in messages], list(range(300)))
        self.assertEqual(messages[5].time_s, 5.0)
        self.assertFalse(skipped)

    def test_a_channel_is_chosen(self):
        log = self.poses(2)[0] + event(1, "PHAROS_STATUS", examples.status().encode())
        messages, _ = self.read(log, ["PHAROS_STATUS"])
        self.assertEqual([message.channel for message in messages], ["PHAROS_STATUS"])

    def test_messages_of_other_programs_are_counted(self):
        messages, skipped = self.read(event(0, "OTHER", b"any bytes") + self.poses(1)[0])
        self.assertEqual(len(messages), 1)
        self.assertEqual(sum(skipped.values()), 1)

    def test_a_log_that_is_cut_off_anywhere_gives_the_events_before(self):
        poses = self.poses(3)
        log = b"".join(poses)
        for length in range(0, len(log), 7):
            messages, _ = self.read(log[:length])
            self.assertEqual(len(messages), length // len(poses[0]))

    def test_damage_costs_the_event_that_it_hits(self):
        poses = self.poses(200)
        for place in (20, 24):  # the lengths: the worst to lose
            damaged = list(poses)
            damaged[10] = damaged[10][:place] + b"\x00\xff\xff\xff" + damaged[10][place + 4:]
            messages, skipped = self.read(b"".join(damaged))
            self.assertEqual(len(messages), 199)
            self.assertGreaterEqual(sum(skipped.values()), 1)

    def test_any_bytes_end(self):
        chance = random.Random("any_bytes_end")
        log = bytearray(b"".join(self.poses(20)))
        for _ in range(50):
            for _ in range(chance.randint(1, 30)):
                log[chance.randrange(len(log))] = chance.randrange(256)
            self.read(bytes(log))
        self.read(os.urandom(100_000))
        self.read(b"")
        self.read(b"\xed\xa1\xda")


if __name__ == "__main__":
    unittest.main()
