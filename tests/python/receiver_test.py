#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
import os
import random
import socket
import struct
import unittest

import examples
import pharos
from pharos.receiver import split_packet


def packet(channel, data, magic=0x4C433032):
    return struct.pack(">II", magic, 1) + channel.encode() + b"\0" + data


class Packets(unittest.TestCase):
    def test_channel_and_message_are_split(self):
        self.assertEqual(split_packet(packet("A_CHANNEL", b"data")), ("A_CHANNEL", b"data"))
        self.assertEqual(split_packet(packet("A", b"")), ("A", b""))

    def test_what_is_no_whole_message_is_refused(self):
        foreign = [b"", b"LC02", packet("A", b"x", 0), packet("A", b"x", 0x4C433033), packet("N" * 64, b"x"),
                   struct.pack(">II", 0x4C433032, 1) + b"no end"]
        for data in foreign:
            with self.assertRaises(ValueError):
                split_packet(data)


class Live(unittest.TestCase):
    """On this computer's loopback, with a port of its own."""

    def setUp(self):
        port = random.SystemRandom().randint(20_000, 30_000)
        self.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.sender.close)
        self.sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
        self.group = ("239.255.76.67", port)
        self.url = f"udpm://239.255.76.67:{port}?ttl=0"

    def receiver(self, **options):
        receiver = pharos.Receiver(self.url, **options)
        self.addCleanup(receiver.close)
        return receiver

    def send(self, data):
        self.sender.sendto(data, self.group)

    def test_messages_arrive_and_foreign_ones_are_counted(self):
        receiver = self.receiver(timeout_s=10.0)
        self.send(os.urandom(50))
        self.send(packet("PHAROS_LIGHTHOUSE_POSE", b"another program's message"))
        self.send(packet("PHAROS_LIGHTHOUSE_POSE", examples.pose(41).encode()))
        self.send(packet("PHAROS_STATUS", examples.status().encode()))
        pose, status = next(receiver), next(receiver)
        self.assertEqual(pose.message.sequence, 41)
        self.assertEqual(pose.message.position_m, (0.25, -0.5, 2.0))
        self.assertEqual(status.message.sources[0].counters[0].name, "poses_published")
        self.assertEqual(sum(receiver.skipped.values()), 2)
        self.assertEqual(receiver.received["PHAROS_LIGHTHOUSE_POSE"], 1)

    def test_only_the_channels_asked_for_arrive(self):
        receiver = self.receiver(channels=["PHAROS_STATUS"], timeout_s=10.0)
        self.send(packet("PHAROS_LIGHTHOUSE_POSE", examples.pose().encode()))
        self.send(packet("PHAROS_STATUS", examples.status().encode()))
        self.assertEqual(next(receiver).channel, "PHAROS_STATUS")

    def test_silence_ends_the_iteration(self):
        self.assertEqual(list(self.receiver(timeout_s=0.05)), [])

    def test_two_receivers_get_the_same(self):
        receivers = [self.receiver(timeout_s=10.0), self.receiver(timeout_s=10.0)]
        self.send(packet("PHAROS_STATUS", examples.status().encode()))
        self.assertEqual([next(receiver).channel for receiver in receivers], ["PHAROS_STATUS"] * 2)

    def test_a_url_that_is_none_is_refused(self):
        for url in ("tcp://1.2.3.4:5", "udpm://239.255.76.67", "udpm://x:7667"):
            with self.assertRaises(ValueError):
                pharos.Receiver(url)
        with self.assertRaises(OSError):
            pharos.Receiver("udpm://239.255.76.67:99999")


if __name__ == "__main__":
    unittest.main()
