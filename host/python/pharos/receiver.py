# SPDX-License-Identifier: Apache-2.0
"""Live messages of pharosd over LCM's UDP multicast, without LCM's own module, which Debian 12 does not have."""

import re
import socket
import struct
import time
from collections import Counter

from .messages import Message, decode

DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
URL = re.compile(r"udpm://(?P<address>[0-9.]+):(?P<port>[0-9]+)(\?ttl=[0-9]+)?")
# LCM's header of a packet that is a whole message: a magic number and a sequence number, big-endian; then the channel's
# name up to a zero byte, and the message. Larger messages than a packet's 64 KiB have another magic number; Pharos
# sends none.
HEADER = struct.Struct(">II")
WHOLE_MESSAGE = 0x4C433032
FRAGMENT = 0x4C433033
MAX_CHANNEL_BYTES = 63
MAX_PACKET_BYTES = 65536
# The kernel's limit applies (net.core.rmem_max): some seconds of every channel.
RECEIVE_BUFFER_BYTES = 1 << 21


def split_packet(packet):
    """Channel and message of one packet; ValueError if it is none of LCM's or only a part of a message."""
    if len(packet) < HEADER.size:
        raise ValueError("shorter than LCM's header")
    magic, _ = HEADER.unpack_from(packet)
    if magic == FRAGMENT:
        raise ValueError("part of a message larger than a packet")
    end = packet.find(b"\0", HEADER.size)
    if magic != WHOLE_MESSAGE or not HEADER.size <= end <= HEADER.size + MAX_CHANNEL_BYTES:
        raise ValueError("not a packet of LCM")
    return packet[HEADER.size:end].decode("ascii", "replace"), packet[end + 1:]


class Receiver:
    """Iterates over the messages of pharosd as they arrive.

    channels: names, or None for all. timeout_s: the iteration ends when nothing was received for so long; None: never.
    What is not Pharos' or is damaged is skipped and counted in `skipped`, a Counter by reason; `received` counts by
    channel. Every receiver on this computer gets every message."""

    def __init__(self, url=DEFAULT_URL, channels=None, timeout_s=None):
        match = URL.fullmatch(url)
        if match is None:
            raise ValueError(f"{url}: not udpm://ADDRESS:PORT?ttl=N")
        self.channels = None if channels is None else frozenset(channels)
        self.timeout_s = timeout_s
        self.received = Counter()
        self.skipped = Counter()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER_BYTES)
            self._socket.bind((match["address"], int(match["port"])))
            group = socket.inet_aton(match["address"]) + struct.pack("=I", socket.INADDR_ANY)
            self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        except (OSError, OverflowError) as error:
            self._socket.close()
            raise OSError(f"{url}: {error}; without a network: ip route add 224.0.0.0/4 dev lo") from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._socket.close()

    def __iter__(self):
        return self

    def __next__(self):
        quiet_since = time.monotonic()
        while True:
            message = self._receive(quiet_since)
            if message is not None:
                return message

    def _receive(self, quiet_since):
        if self.timeout_s is not None:
            left_s = self.timeout_s - (time.monotonic() - quiet_since)
            if left_s <= 0.0:
                raise StopIteration
            self._socket.settimeout(left_s)
        try:
            packet = self._socket.recv(MAX_PACKET_BYTES)
        except socket.timeout:
            raise StopIteration from None
        return self.take(packet, time.time())

    def take(self, packet, time_s):
        """The message in one packet; None, and counted, if it has none or one of another channel."""
        try:
            channel, data = split_packet(packet)
            if self.channels is not None and channel not in self.channels:
                return None
            message = decode(data)
        except ValueError as error:
            self.skipped[str(error).split(":")[0]] += 1
            return None
        self.received[channel] += 1
        return Message(channel, time_s, message)
