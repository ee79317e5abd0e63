#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: hostile_clients_test.py PHAROS LCM_GEN

`pharos view` among 10,000 hostile connections: half requests, silence, garbage, path traversal, wrong tokens, other
origins, hosts and methods, slow and dying viewers. Three viewers receive states all the while, no more than 64
connections are served, and the program's memory does not grow."""

import pathlib
import random
import re
import socket
import sys
import threading
import time

from running_view import RunningView, load_types, pose

PROGRAM, LCM_GEN = sys.argv[1:3]
CONNECTIONS = 10_000
HELD = 300  # at once, more than are served


def connect(port):
    client = socket.create_connection(("127.0.0.1", port), timeout=10)
    client.settimeout(10)
    return client


class Viewer(threading.Thread):
    """Takes every state, and notes the longest time without one."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.client = connect(port)
        self.client.sendall(f"GET /states HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
        self.states, self.longest_s, self.error = 0, 0.0, None
        self.running = True

    def run(self):
        last = time.monotonic()
        try:
            while self.running:
                piece = self.client.recv(1 << 20)
                if not piece:
                    raise ConnectionError("ended by the server")
                now = time.monotonic()
                count = piece.count(b"data: ")
                if count:
                    self.longest_s = max(self.longest_s, now - last)
                    last = now
                self.states += count
        except OSError as error:
            if self.running:
                self.error = error


def hostile_bytes(rng, port):
    host = f"Host: 127.0.0.1:{port}\r\n"
    kinds = [
        "", "GET", f"GET / HTTP/1.1\r\n{host}", f"GET /../../../../etc/passwd HTTP/1.1\r\n{host}\r\n",
        f"GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\n{host}\r\n", f"GET /?token=wrong HTTP/1.1\r\n{host}\r\n",
        f"GET /states HTTP/1.1\r\n{host}Origin: http://evil.example\r\n\r\n", "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n",
        f"POST /control?seek=1 HTTP/1.1\r\n{host}Content-Length: 99999999\r\n\r\n", f"DELETE / HTTP/1.1\r\n{host}\r\n",
        f"GET /states HTTP/1.1\r\n{host}\r\n", f"GET /three.min.js HTTP/1.1\r\n{host}\r\n",
        f"GET /{'A' * 100_000} HTTP/1.1\r\n{host}\r\n", f"GET / HTTP/1.1\r\n{host}" + "X: y\r\n" * 5000,
    ]
    kind = rng.randrange(len(kinds) + 1)
    return rng.randbytes(rng.randrange(3000)) if kind == len(kinds) else kinds[kind].encode()


def attack(port, count, rng):
    """Opens connections one after another and holds HELD of them; what their first bytes of an answer were."""
    held, answers = [], {}
    for _ in range(count):
        client = connect(port)
        client.setblocking(False)
        try:
            client.send(hostile_bytes(rng, port))
        except OSError:
            pass
        held.append(client)
        if len(held) < HELD:
            continue
        oldest = held.pop(rng.randrange(len(held)))
        try:
            status = re.match(rb"HTTP/1\.1 (\d+)", oldest.recv(4096))
            name = status[1].decode() if status else "other"
        except BlockingIOError:
            name = "none yet"
        except OSError:
            name = "reset"
        answers[name] = answers.get(name, 0) + 1
        oldest.close()
    for client in held:
        client.close()
    return answers


def resident_kib(pid):
    return int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text())[1])


def main():
    types = load_types(LCM_GEN)
    view = RunningView(PROGRAM)
    publishing = True

    def publish():
        sequence = 0
        while publishing:
            view.publish("PHAROS_LIGHTHOUSE_POSE", pose(types, "dock", (0, 0, 2), sequence))
            sequence += 1
            time.sleep(1 / 60)

    sender = threading.Thread(target=publish, daemon=True)
    sender.start()
    viewers = [Viewer(view.port) for _ in range(3)]
    for viewer in viewers:
        viewer.start()
    time.sleep(2)
    attack(view.port, 1000, random.Random(1))  # everything is allocated once
    before = resident_kib(view.process.pid)
    states_before = [viewer.states for viewer in viewers]
    start = time.monotonic()
    answers = attack(view.port, CONNECTIONS, random.Random(2))
    duration = time.monotonic() - start
    after = resident_kib(view.process.pid)
    descriptors = len(list(pathlib.Path(f"/proc/{view.process.pid}/fd").iterdir()))
    states = [viewer.states - was for viewer, was in zip(viewers, states_before)]
    time.sleep(7)  # half requests have had their time
    page = connect(view.port)
    page.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{view.port}\r\nConnection: close\r\n\r\n".encode())
    served_again = page.recv(100).startswith(b"HTTP/1.1 200")
    for viewer in viewers:
        viewer.running = False
    print(f"{CONNECTIONS} connections in {duration:.1f} s: answers {answers}")
    print(f"viewers: {states} states, longest time without one {max(v.longest_s for v in viewers):.2f} s")
    print(f"memory {before} -> {after} KiB, {descriptors} descriptors")
    failures = []
    if any(viewer.error for viewer in viewers):
        failures.append(f"a viewer was disturbed: {[viewer.error for viewer in viewers]}")
    if min(states) == 0:
        failures.append("a viewer received nothing")
    if answers.get("503", 0) == 0:
        failures.append("nobody was refused with 503")
    if descriptors > 64 + 64 + 40:
        failures.append("more connections are open than may be served")
    if after > before + 8192:
        failures.append("memory grew")
    if not served_again:
        failures.append("the page is not served afterwards")
    publishing = False
    sender.join()
    if view.close() != 0:
        failures.append("pharos view did not end with 0")
    for failure in failures:
        print(f"FAILED: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
