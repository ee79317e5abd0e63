#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tapes of the capture block's words (firmware/board/qemu_virt/capture_replay.hpp), the decoder image that reads them, and the
frames that it sends. As a program: converts records without times (edges_through_capture) on standard input to a complete
tape."""

import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

GAP, OVERFLOW = 0x10000, 0x20000
TICKS_PER_MS = 50_000
HELLO, COUNTERS, TIME, SWEEP = 0x01, 0x02, 0x03, 0x10
DECODER, DEVICE = 0, 1
DEVICE_NAMES = ("capture_overflows", "edges_lost", "frames_sent", "frames_skipped", "commands", "commands_refused",
                "receive_errors", "busy_permille", "stack_free_bytes", "poses_skipped")


def record(time, changed, levels, flags=0):
    return struct.pack("<4I", 1 | flags, time & 0xFFFFFFFF, changed, levels)


def look(now, lost=0, flags=0):
    return struct.pack("<4I", flags, now & 0xFFFFFFFF, now >> 32 & 0xFFFFFFFF, lost)


def looks(begin, end, lost=0):
    return b"".join(look(now, lost) for now in range(begin, end, TICKS_PER_MS))


END = struct.pack("<4I", 0xFFFFFFFF, 0, 0, 0)


def whole(records):
    """Records alone, within one turn of the 32-bit counter -> a tape with a read of the clock every millisecond, from before them
    to 1.3 s after them."""
    tape = bytearray()
    now = struct.unpack_from("<I", records, 4)[0] - TICKS_PER_MS
    for at in range(0, len(records), 16):
        time = struct.unpack_from("<I", records, at + 4)[0]
        assert time + TICKS_PER_MS >= now, "the counter wraps within these records"
        while now < time:
            tape += look(now)
            now += TICKS_PER_MS
        tape += records[at : at + 16]
    return bytes(tape) + looks(now, now + 1300 * TICKS_PER_MS) + END


def unstuffed(stuffed):
    plain = bytearray()
    at = 0
    while at < len(stuffed):
        code = stuffed[at]
        plain += stuffed[at + 1 : at + code]
        at += code
        if code != 0xFF and at < len(stuffed):
            plain.append(0)
    return bytes(plain)


def frames_of(line):
    """(type, payload) of every frame; all must be valid and in sequence."""
    frames = []
    for number, stuffed in enumerate(filter(None, line.split(b"\0"))):
        frame = unstuffed(stuffed)
        assert zlib.crc32(frame[:-4]) == struct.unpack("<I", frame[-4:])[0], f"frame {number} is damaged"
        assert struct.unpack_from("<H", frame, 2)[0] == number & 0xFFFF, f"frame {number} has another number"
        frames.append((frame[1], frame[4:-4]))
    return frames


def device_counters(frames):
    lists = [payload for kind, payload in frames if kind == COUNTERS and payload[8] == DEVICE]
    return [dict(zip(DEVICE_NAMES, struct.unpack_from(f"<{payload[9]}I", payload, 10)), time=struct.unpack_from("<q", payload)[0])
            for payload in lists]


def run(image, tape, options=()):
    """Output of the image's UART, as frames; the emulator must have reached the tape's end by itself. `options`: QEMU's."""
    emulator = pathlib.Path(__file__).resolve().parents[2] / "tools" / "lib" / "emulator.sh"
    with tempfile.TemporaryDirectory() as folder:
        line = pathlib.Path(folder) / "line"
        script = f'. "{emulator}"; emulate "{image}" "{line}" "$@"'
        done = subprocess.run(["bash", "-c", script, "emulate", *options], input=tape, timeout=1800, check=False)
        assert done.returncode == 0, f"the emulator ended with {done.returncode}"
        return frames_of(line.read_bytes())


if __name__ == "__main__":
    sys.stdout.buffer.write(whole(sys.stdin.buffer.read()))
