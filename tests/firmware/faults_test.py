#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: faults_test.py PHAROS IMAGE SCENARIO: a FIFO that overflows and edges faster than any budget, in the middle of good light.
The firmware keeps running, counts losses, and continues. 77 = skipped."""

import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

import tape

SECOND = 1000 * tape.TICKS_PER_MS
PACKET = struct.Struct("<4I")


def light_of(pharos, scenario):
    with tempfile.TemporaryDirectory() as folder:
        words = pathlib.Path(folder) / "words"
        subprocess.run([pharos, "sim", "capture", scenario, "--output", words], check=True, stderr=subprocess.DEVNULL)
        packets = list(PACKET.iter_unpack(words.read_bytes()))
    start = packets[0][1]
    light = [packet for packet in packets if packet[1] - start < 8 * SECOND and packet[0] != 0xFFFFFFFF]
    # A short time without light, so that the last frame is sent completely.
    return start, light + list(PACKET.iter_unpack(tape.looks(start + 8 * SECOND, start + 8 * SECOND + 10 * tape.TICKS_PER_MS)))


def is_record(packet):
    return packet[0] & 0xFFFF != 0


def pack(packets):
    return b"".join(PACKET.pack(*packet) for packet in packets) + tape.END


def sweeps_between(frames, begin, end):
    starts = [struct.unpack_from("<q", payload)[0] for kind, payload in frames if kind == tape.SWEEP]
    return sum(begin <= start < end for start in starts)


def check_alive(frames, start):
    """A single start, counters to the end, and all the sweeps of the last two seconds."""
    starts = {struct.unpack_from("<H", payload, 6)[0] for kind, payload in frames if kind == tape.HELLO}
    assert len(starts) == 1, f"the firmware started anew: {starts}"
    found = sweeps_between(frames, start + 5 * SECOND, start + 7 * SECOND)
    assert 238 <= found <= 241, f"{found} sweeps in two seconds of good light, 240 expected"


def fifo_overflow(image, start, light):
    begin, end = start + 3 * SECOND, start + 3 * SECOND + 60 * tape.TICKS_PER_MS
    packets, lost, lit = [], 0, 0
    for packet in light:
        dropped = is_record(packet) and begin <= packet[1] < end
        if dropped:
            lost += packet[2].bit_count()
        elif is_record(packet) and lost and not lit:
            packets.append((packet[0] | tape.GAP | tape.OVERFLOW, *packet[1:]))
            lit = 1
        elif is_record(packet):
            packets.append(packet)
        else:
            packets.append((*packet[:3], lost))
    frames = tape.run(image, pack(packets))
    check_alive(frames, start)
    device = tape.device_counters(frames)[-1]
    assert lost > 100, "nothing was dropped"
    assert device["edges_lost"] == lost, f"{lost} edges were lost, told are {device}"
    assert device["capture_overflows"] == 1, f"one overflow, told are {device}"
    assert sweeps_between(frames, begin, end) < 7, "sweeps of light that nobody saw"
    print(f"fifo overflow: {lost} edges lost and told, sweeps before and after")


def flood(image, start, light):
    begin = start + 3 * SECOND
    end = begin + 40 * tape.TICKS_PER_MS
    edges = [(1, time, 0xFFFFFFFF, 0xFFFFFFFF if n % 2 == 0 else 0) for n, time in enumerate(range(begin, end, 500))]
    edges = edges[: len(edges) // 2 * 2]
    packets = [p for p in light if p[1] < begin] + edges + [p for p in light if p[1] >= end]
    frames = tape.run(image, pack(packets))
    check_alive(frames, start)
    into_decoder = [struct.unpack_from("<I", payload, 10)[0] for kind, payload in frames
                    if kind == tape.COUNTERS and payload[8] == tape.DECODER]
    asked = sum(p[2].bit_count() for p in packets if is_record(p) and p[1] < start + 7 * SECOND)
    assert into_decoder[-1] >= asked, f"{asked} edges came in, the decoder counts {into_decoder[-1]}"
    print(f"flood: {32 * len(edges)} edges in 40 ms, all counted, sweeps before and after")


if __name__ == "__main__":
    if shutil.which("qemu-system-riscv32") is None:
        print("skipped: qemu-system-riscv32 is not installed (tools/install-dependencies test)")
        sys.exit(77)
    program, firmware, scenario_file = sys.argv[1:]
    beginning, good_light = light_of(program, scenario_file)
    fifo_overflow(firmware, beginning, good_light)
    flood(firmware, beginning, good_light)
