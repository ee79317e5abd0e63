# SPDX-License-Identifier: Apache-2.0
"""A target under QEMU that can be switched on and off: the loader, with its flash in a file and a pseudo-terminal as its line;
and a line that is slow and loses bytes."""

import os
import pathlib
import pty
import random
import re
import select
import shutil
import socket
import struct
import subprocess
import termios
import threading
import time
import tty
import zlib

from tape import unstuffed

FLASH_BYTES = 32 << 20  # size of the machine's flash bank
FLOOR_OFFSET = 0xC0000
VERIFIER_OFFSET = 0x100000  # board/qemu_virt/loader_board.hpp
HELLO, COMMAND = 1, 0x30
RESIDUE = 0x2144DF1C
DECODER, LOADER = 0, 1


class Hello:
    def __init__(self, payload):
        self.role, self.reset_cause = payload[0], payload[1]
        self.version = tuple(payload[3:6])
        self.start_count = struct.unpack_from("<H", payload, 6)[0]
        self.board = payload[28:52].rstrip(b"\0").decode()


def raw_line(fd):
    tty.setraw(fd, termios.TCSANOW)


class QemuTarget:
    """`flash`: the file with the flash's content; created empty when there is none. `edges`: a socket for the capture block's
    words, which determine the decoder's time. As a context: switched off at its end."""

    def __init__(self, images: pathlib.Path, flash: pathlib.Path, edges: pathlib.Path | None = None):
        self.loader = images / "qemu_virt_loader.elf"
        self.flash = flash
        self.edges = edges
        self.jumper = False  # development
        self.machine = None
        self.line = -1
        self.port = None
        self.received = b""
        if not flash.exists():
            flash.touch()
            os.truncate(flash, FLASH_BYTES)
            self.write_flash(FLOOR_OFFSET, b"\xff" * 4096)
            self.write_flash(VERIFIER_OFFSET, (images / "verifier.bin").read_bytes())

    def write_flash(self, offset, data):
        """As a programmer does; while the power is off."""
        with self.flash.open("r+b") as file:
            file.seek(offset)
            file.write(data)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.switch_off()

    def switch_on(self):
        capture = []
        if self.edges:
            capture = ["-chardev", f"socket,id=edges,path={self.edges},server=on,wait=off", "-device", "virtio-serial-device",
                       "-device", "virtconsole,chardev=edges"]
        if self.jumper:
            capture += ["-device", "loader,addr=0x8070fffc,data=1,data-len=4"]
        self.machine = subprocess.Popen(
            ["qemu-system-riscv32", "-M", "virt", "-smp", "1", "-m", "32M", "-bios", "none", "-nodefaults", "-display", "none",
             "-serial", "pty", "-device", f"loader,file={self.loader},cpu-num=0",
             "-drive", f"if=pflash,unit=1,format=raw,file={self.flash}", *capture],
            stdout=subprocess.PIPE, text=True)
        first = self.machine.stdout.readline()
        found = re.search(r"/dev/pts/\d+", first)
        if not found:
            raise RuntimeError(f"QEMU did not start: {first}")
        self.port = found[0]
        # Kept open: the machine sends only while the other end is open.
        self.line = os.open(self.port, os.O_RDWR | os.O_NOCTTY)
        raw_line(self.line)
        self.received = b""
        if self.edges:
            threading.Thread(target=self.feed_time, daemon=True).start()

    def feed_time(self):
        """Repeated reads of an empty capture FIFO, with its time (board/qemu_virt/capture_tape.hpp)."""
        tape = socket.socket(socket.AF_UNIX)
        began = time.monotonic()
        try:
            tape.connect(str(self.edges))
            while True:
                ticks = int((time.monotonic() - began) * 50e6)
                tape.sendall(struct.pack("<IQI", 0, ticks, 0))
                time.sleep(0.002)
        except OSError:
            pass  # switched off
        tape.close()

    def switch_off(self):
        """Power cut: SIGKILL. Data written to the flash are in the file."""
        if self.machine:
            self.machine.kill()
            self.machine.wait()
            self.machine.stdout.close()
            os.close(self.line)
            self.machine = None

    def hello(self, seconds=20.0):
        """The next Hello on the line; None on timeout. Not while another program uses the line."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            while b"\0" in self.received:
                frame, self.received = self.received.split(b"\0", 1)
                plain = unstuffed(frame)
                if len(plain) >= 8 and zlib.crc32(plain) == RESIDUE and plain[1] == HELLO:
                    return Hello(plain[4:-4])
            if select.select([self.line], [], [], 0.1)[0]:
                self.received += os.read(self.line, 4096)
        return None

    def command(self, code):
        """Sends a Command frame; the response is among the other frames."""
        plain = struct.pack("<BBHBI", 1, COMMAND, 1, code, 0)
        plain += struct.pack("<I", zlib.crc32(plain))
        blocks = b"".join(bytes([len(block) + 1]) + block for block in plain.split(b"\0"))
        os.write(self.line, b"\0" + blocks + b"\0")

    def forget(self):
        """Drops received bytes."""
        self.received = b""
        while select.select([self.line], [], [], 0)[0]:
            os.read(self.line, 4096)


class PoorLine:
    """A line between `port` and another pseudo-terminal: with the speed of `baud`, and one lost byte of so many."""

    def __init__(self, port, baud, lost_of=None, seed=1):
        self.seconds_a_byte = 10 / baud
        self.lost_of = lost_of
        self.bytes = 0  # towards the target
        self.target = os.open(port, os.O_RDWR | os.O_NOCTTY)
        self.host, self.held = pty.openpty()
        raw_line(self.held)
        self.port = os.ttyname(self.held)
        self.open = True
        for source, sink, counts in ((self.host, self.target, True), (self.target, self.host, False)):
            threading.Thread(target=self.carry, args=(source, sink, counts, random.Random(seed)), daemon=True).start()

    def carry(self, source, sink, counts, dice):
        free = time.monotonic()
        while self.open:
            if not select.select([source], [], [], 0.1)[0]:
                continue
            data = os.read(source, 64)
            if counts:
                self.bytes += len(data)
            free = max(free, time.monotonic()) + len(data) * self.seconds_a_byte
            time.sleep(max(0.0, free - time.monotonic()))
            if self.lost_of:
                data = bytes(byte for byte in data if dice.randrange(self.lost_of))
            os.write(sink, data)

    def close(self):
        self.open = False


def have_qemu():
    return shutil.which("qemu-system-riscv32") is not None
