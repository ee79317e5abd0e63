# SPDX-License-Identifier: Apache-2.0
"""A running `pharos view` with its own multicast port, and what a test sends it."""

import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time

PROTO = pathlib.Path(__file__).resolve().parents[3] / "proto"


def load_types(lcm_gen):
    """Python modules of the LCM types; they need no LCM."""
    folder = tempfile.mkdtemp(prefix="pharos_types_")
    subprocess.run([lcm_gen, "-p", "--ppath", folder, *map(str, sorted(PROTO.glob("*.lcm")))], check=True)
    sys.path.insert(0, folder)
    import pharos  # noqa: the module made just now
    return pharos


class RunningView:
    def __init__(self, program, *arguments):
        self.group = ("239.255.76.67", 20000 + os.getpid() % 10000)
        self.process = subprocess.Popen(
            [program, "view", "--port", "0", *(arguments or ("--url", f"udpm://{self.group[0]}:{self.group[1]}?ttl=0"))],
            stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        match = re.match(r"http://127\.0\.0\.1:(\d+)/", self.address)
        if not match:
            raise RuntimeError(f"pharos view printed {self.address!r}")
        self.port = int(match[1])
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.number = 0

    def publish(self, channel, message):
        """One message as LCM sends a short one."""
        content = message if isinstance(message, bytes) else message.encode()
        self.socket.sendto(struct.pack(">II", 0x4C433032, self.number) + channel.encode() + b"\0" + content, self.group)
        self.number += 1

    def close(self):
        self.socket.close()
        self.process.terminate()
        code = self.process.wait(20)
        self.process.stdout.close()
        return code


def target_state(types, target, position, sequence):
    made = types.target_state_t()
    made.utime = int(time.time() * 1e6)
    made.sequence, made.target, made.mode, made.valid = sequence, target, "fused", True
    made.position_m = list(position)
    made.orientation_wxyz = [1, 0, 0, 0]
    made.covariance = [1e-6 if k % 13 == 0 else 0 for k in range(144)]
    made.position_protection_available, made.position_protection_m = True, 0.25
    source = types.fused_source_t()
    source.name, source.state, source.reason, source.age_us = "tof", "excluded", "step", 1000
    made.sources, made.source_count = [source], 1
    made.conflict_without = ["", ""]
    return made


def preview(types, source, jpeg, sequence):
    made = types.preview_t()
    made.utime = int(time.time() * 1e6)
    made.sequence, made.source, made.station_or_camera, made.target = sequence, source, source.split("/")[1], "client"
    made.status, made.width_px, made.height_px, made.format = "ok", 160, 120, "jpeg"
    made.data, made.size = jpeg, len(jpeg)
    return made


def pose(types, target, position, sequence, source="lighthouse/chaser", **fields):
    made = types.pose_t()
    made.utime = int(time.time() * 1e6)
    made.sequence = sequence
    made.source, made.target = source, target
    made.parent_frame, made.child_frame = "lighthouse", "body"
    made.station_or_camera = "C33B4DE1"
    made.status, made.valid = "ok", True
    made.position_m = list(position)
    made.orientation_wxyz = [1, 0, 0, 0]
    made.covariance = [1e-6 if k % 7 == 0 else 0 for k in range(36)]
    made.sigma_rot_rad = made.sigma_pos_m = 1e-3
    for name, value in fields.items():
        setattr(made, name, value)
    return made
