#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds and runs the examples of SUBSCRIBER.md while messages are sent to them. usage: ... SUBSCRIBER.md FOLDER"""

import os
import pathlib
import random
import re
import socket
import struct
import subprocess
import sys
import threading
import time

import pharos

BLOCK = re.compile(r"^```(cpp|cmake|sh|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
DEFAULT = "239.255.76.67:7667"
TIMEOUT_S = 60.0


def pose(sequence, **changes):
    message = pharos.pose_t()
    message.utime, message.sequence, message.target = int(time.time() * 1e6), sequence, "target12"
    message.status, message.valid, message.position_m = "ok", True, [0.25, -0.5, 2.125]
    message.orientation_wxyz = [1.0, 0.0, 0.0, 0.0]
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def messages(sequence):
    """A pose that may steer, one that may not, a refused one, a status."""
    source = pharos.source_status_t()
    source.source, source.state, source.message = "lighthouse/bench", "stale", "no light"
    status = pharos.status_t()
    status.sources, status.source_count = [source], 1
    return [("PHAROS_LIGHTHOUSE_POSE", pose(sequence)),
            ("PHAROS_LIGHTHOUSE_POSE", pose(sequence + 1, flags="uncalibrated")),
            ("PHAROS_LIGHTHOUSE_POSE", pose(sequence + 2, status="refused_too_few_sensors", valid=False)),
            ("PHAROS_STATUS", status)]


class Sender(threading.Thread):
    """Sends all messages twenty times a second to a port of its own."""

    def __init__(self):
        super().__init__(daemon=True)
        self.address = ("239.255.76.67", random.SystemRandom().randint(20_000, 30_000))
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)

    def run(self):
        sequence = 0
        while True:
            for channel, message in messages(sequence):
                packet = struct.pack(">II", 0x4C433032, sequence) + channel.encode() + b"\0" + message.encode()
                self.socket.sendto(packet, self.address)
            sequence += 3
            time.sleep(0.05)

    def redirect(self, text):
        """The example with this sender's port in place of the default one."""
        text = text.replace(DEFAULT, f"{self.address[0]}:{self.address[1]}")
        return text.replace("pharos.Receiver(", f'pharos.Receiver("udpm://{self.address[0]}:{self.address[1]}?ttl=0", ')


def write_inputs(folder):
    (folder / "poses.csv").write_text("time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m,status\n"
                                      "1.0,0,1,0,0,0,0.1,0.2,2,ok\n1.1,0,,,,,,,,refused_degenerate\n")
    with open(folder / "log.lcm", "wb") as log:
        for number, (channel, message) in enumerate(messages(40)):
            data = message.encode()
            log.write(struct.pack(">IqqII", 0xEDA1DA01, number, 1_000_000, len(channel), len(data)) + channel.encode() + data)


def output_until(command, folder, expected):
    """What a program prints until it has printed every expected text."""
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env={**os.environ, "PYTHONUNBUFFERED": "1"})
    watchdog = threading.Timer(TIMEOUT_S, process.kill)
    watchdog.start()
    text = ""
    for line in process.stdout:
        text += line
        if all(part in text for part in expected):
            break
    watchdog.cancel()
    process.kill()
    process.wait()
    missing = [part for part in expected if part not in text]
    if missing:
        sys.exit(f"{command}: {missing} missing in\n{text}")


EXPECTED = {
    "PHAROS_LIGHTHOUSE_POSE": ["target12 (0.25, -0.5, 2.125)", "not for steering: ok uncalibrated", "refused_too_few_sensors"],
    "PHAROS_STATUS": ["lighthouse/bench stale 0.0/s no light"],
    "read_table": ["1 poses; mean position [0.1 0.2 2. ]"],
    "read_log": ["1.0 40 ok", "1.0 42 refused_too_few_sensors", "{}"],
}


def main():
    document, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir()
    write_inputs(folder)
    sender = Sender()
    sender.start()
    blocks = BLOCK.findall(document.read_text())
    of = {kind: [text for found, text in blocks if found == kind] for kind in ("cpp", "cmake", "sh", "python")}

    (folder / "subscriber.cpp").write_text(sender.redirect(of["cpp"][0]))
    (folder / "CMakeLists.txt").write_text(of["cmake"][0])
    subprocess.run(["cmake", "-S", ".", "-B", "build", "-G", "Ninja"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "build"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["sh", "-ec", of["sh"][0]], cwd=folder, check=True)
    for program in ("build/subscriber", "./subscriber"):
        output_until([folder / program], folder,
                     ["target12: z 2.1250 m", "PHAROS_LIGHTHOUSE_POSE target12: refused_too_few_sensors"])

    for text in of["python"]:
        kind = next((name for name in ("PHAROS_STATUS", "read_table", "read_log") if name in text), "PHAROS_LIGHTHOUSE_POSE")
        output_until([sys.executable, "-c", sender.redirect(text)], folder, EXPECTED.pop(kind))
    if EXPECTED or len(of["cpp"]) != 1:
        sys.exit(f"examples are missing: {sorted(EXPECTED)}")
    print(f"{len(of['python'])} examples in Python, one in C++ built in two ways")


if __name__ == "__main__":
    main()
