# SPDX-License-Identifier: Apache-2.0
"""Logs of lcm-logger, and of pharosd with [lcm] url = "file:///FILE?mode=w"."""

import struct
from collections import Counter

from .messages import Message, decode

# An event: a mark, its number, its time in microseconds since 1970, the lengths of channel and data; big-endian.
EVENT = struct.Struct(">IqqII")
MARK = struct.pack(">I", 0xEDA1DA01)
MAX_CHANNEL_BYTES = 63
MAX_DATA_BYTES = 1 << 24
CHUNK_BYTES = 1 << 16


class _Window:
    """The part of a file that is being looked at."""

    def __init__(self, file):
        self._file = file
        self.bytes = b""

    def fill(self, count):
        """Whether there are `count` bytes."""
        while len(self.bytes) < count:
            chunk = self._file.read(max(CHUNK_BYTES, count - len(self.bytes)))
            if not chunk:
                return False
            self.bytes += chunk
        return True

    def drop(self, count):
        self.bytes = self.bytes[count:]

    def seek_mark(self):
        """Goes to the next mark; how many bytes were left behind, None if there is no mark any more."""
        left = 0
        while (start := self.bytes.find(MARK)) < 0:
            keep = min(len(self.bytes), len(MARK) - 1)
            left += len(self.bytes) - keep
            self.drop(len(self.bytes) - keep)
            if not self.fill(keep + 1):
                return None
        self.drop(start)
        return left + start


def _whole_event(window):
    """The bytes of the event at the window's start: between its mark and the next one, or the file's end. None if its
    lengths say otherwise: it is damaged or cut off."""
    if not window.fill(EVENT.size):
        return None
    *_, channel_bytes, data_bytes = EVENT.unpack_from(window.bytes)
    if channel_bytes > MAX_CHANNEL_BYTES or data_bytes > MAX_DATA_BYTES:
        return None
    size = EVENT.size + channel_bytes + data_bytes
    followed = window.fill(size + len(MARK))
    if len(window.bytes) < size or (followed and window.bytes[size:size + len(MARK)] != MARK):
        return None
    return window.bytes[:size]


def _events(file):
    """(time_us, channel, data) of every whole event, None where bytes had to be left out."""
    window = _Window(file)
    while (left := window.seek_mark()) is not None:
        event = _whole_event(window)
        if left or event is None:
            yield None
        if event is None:
            window.drop(1)
            continue
        _, _, time_us, channel_bytes, _ = EVENT.unpack_from(event)
        data = EVENT.size + channel_bytes
        yield time_us, event[EVENT.size:data].decode("ascii", "replace"), event[data:]
        window.drop(len(event))


def read_log(path, channels=None, skipped=None):
    """Iterates over the messages of a log. channels: names, or None for all. skipped: a Counter that gets, by reason,
    what was left out: events of other programs, damaged ones, one that the file's end cut off."""
    wanted = None if channels is None else frozenset(channels)
    skipped = Counter() if skipped is None else skipped
    with open(path, "rb") as file:
        for event in _events(file):
            if event is None:
                skipped["damaged or cut off bytes"] += 1
                continue
            time_us, channel, data = event
            if wanted is not None and channel not in wanted:
                continue
            try:
                message = decode(data)
            except ValueError as error:
                skipped[str(error).split(":")[0]] += 1
                continue
            yield Message(channel, time_us * 1e-6, message)
