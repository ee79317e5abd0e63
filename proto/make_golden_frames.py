#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes golden_frames.txt: one frame of every type, made from the byte tables of README.md and not by our C++ code.

usage: ./make_golden_frames.py > golden_frames.txt
"""
import struct
import zlib


def stuffed(data):
    """Consistent Overhead Byte Stuffing."""
    out = bytearray()
    rest = data + b"\0"
    while rest:
        run = rest[:254]
        if b"\0" in run:
            run = run[: run.index(b"\0")]
            rest = rest[len(run) + 1:]
        else:
            rest = rest[254:]
            if rest == b"\0":  # a full block at the very end needs no successor
                rest = b""
        out += bytes([len(run) + 1]) + run
    return bytes(out)


def frame(sequence, kind, payload, version=1):
    body = struct.pack("<BBH", version, kind, sequence) + payload
    body += struct.pack("<I", zlib.crc32(body))
    return b"\0" + stuffed(body) + b"\0"


def varint(value):
    value = value << 1 if value >= 0 else (-value << 1) - 1
    out = bytearray()
    while value >= 0x80:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(out) + bytes([value])


def sweep(start, length, period, sensors, flags, bits, hits):
    return struct.pack("<qiIBBBB", start, length, period, sensors, flags, bits, len(hits)) + b"".join(
        struct.pack("<BHi", *hit) for hit in hits)


def edges(lost, stamps):
    out = struct.pack("<IqB", lost, stamps[0][1], len(stamps))
    previous = stamps[0][1]
    for head, stamp in stamps:
        out += bytes([head]) + varint(stamp - previous)
        previous = stamp
    return out


POSE = struct.pack("<4d3d", 0.5, -0.5, 0.5, 0.5, 0.125, -0.25, 3.0)
POSE2 = struct.pack("<4d3d", 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.5)
COVARIANCE = struct.pack("<21f", *[k / 64 for k in range(1, 22)])
ANSWER = POSE + COVARIANCE + struct.pack("<3fB", 0.0009765625, 1234.5, 56.25, 4)
def lh2_sweep(ticks, sixths, channel, plane, slow_bit, hits):
    return struct.pack("<qBBB", ticks, sixths, channel | plane << 4 | slow_bit << 5, len(hits)) + b"".join(
        struct.pack("<BHi", *hit) for hit in hits)


LH2_OOTX = bytes.fromhex("8808ef9803fe0000559e46aadb29010f94359730007ffca63f7440e39c599c88003042d735412fbeb27c06")
OOTX = bytes.fromhex("063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100")

FRAMES = [
    ("hello", 0x01, struct.pack("<BBBBBBHIIqI24s24s", 0, 1, 1, 0, 1, 0, 7, 50000000, 0xFFF, 123456789, 0xDEADBEEF,
                                b"virtual-rv32", b"chaser")),
    ("counters_decoder", 0x02, struct.pack("<qBB", 50000000, 0, 3) + struct.pack("<3I", 1000, 0, 4294967295)),
    ("counters_device", 0x02, struct.pack("<qBB", 50000000, 1, 2) + struct.pack("<2I", 5, 6)),
    ("time", 0x03, struct.pack("<q", 0x0102030405060708 >> 4)),
    ("sweep_dark", 0x10, sweep(-5, 5208, 13333333, 12, 0, 0b1001, [])),
    ("sweep", 0x10, sweep(4294967296, 3125, 13333340, 9, 1, 0b0110,
                          [(0, 208, 300001), (1, 207, 299990), (31, 7500, 0), (0, 180, 302000)])),
    ("sweep_full", 0x10, sweep(1 << 40, 3646, 13333333, 32, 7, 0b0010,
                               [(k // 2, 200 + k, 100000 + 5000 * k) for k in range(64)])),
    ("ootx", 0x11, struct.pack("<qBB", 987654321, 1, len(OOTX)) + OOTX),
    ("pose", 0x12, struct.pack("<qBBBBH", 777777, 0, 1, 0, 1, 23) + ANSWER),
    ("pose_ambiguous", 0x12, struct.pack("<qBBBBH", 777777, 1, 0, 0, 3, 8) + ANSWER + POSE2 + struct.pack("<f", 2.5)),
    ("pose_refused", 0x12, struct.pack("<qBBBBH", 777777, 0, 0, 1, 0, 5)),
    ("raw_edges", 0x13, edges(2, [(0x80 | 3, 1000), (0x80 | 4, 1010), (0x80 | 31, 1005), (3, 4200), (4, 4211),
                                  (31, 420000)])),
    ("command", 0x30, struct.pack("<BI", 2, 5)),
    ("loader_query", 0x40, b""),
    ("loader_info", 0x41, struct.pack("<HHII24s", 1, 256, 0x80004000, 28672, b"virtual-rv32")),
    ("loader_begin", 0x42, struct.pack("<II24s", 20000, 0x12345678, b"virtual-rv32")),
    ("loader_data", 0x43, struct.pack("<IH", 512, 256) + bytes(range(256))),
    ("loader_verify", 0x44, b""),
    ("loader_start", 0x45, b""),
    ("ack", 0x46, struct.pack("<BHI", 0x43, 16, 768)),
    ("nak", 0x47, struct.pack("<BHBI", 0x43, 17, 3, 768)),
    ("lh2_sweep", 0x14, lh2_sweep(4294967296, 5, 6, 1, 1, [(0, 405, 1894537), (31, 1, 0), (0, 5000, 5993750)])),
    ("lh2_sweep_empty", 0x14, lh2_sweep(-7, 0, 15, 0, 0, [])),
    ("lh2_sweep_full", 0x14, lh2_sweep(1 << 40, 3, 0, 0, 0, [(k // 2, 300 + k, 1900000 + 700 * k) for k in range(64)])),
    ("lh2_ootx", 0x15, struct.pack("<qBB", 987654321, 8, len(LH2_OOTX)) + LH2_OOTX),
]

print("# SPDX-License-Identifier: Apache-2.0")
print("# One frame of every type as it travels, made by make_golden_frames.py: name, type, sequence number, bytes.")
for number, (name, kind, payload) in enumerate(FRAMES):
    print(name, f"0x{kind:02x}", number, frame(number, kind, payload).hex())
