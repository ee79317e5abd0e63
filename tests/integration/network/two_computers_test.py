#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The same approach on one computer and on two: cameras in one network namespace, lighthouse and fusion in another, clocks 5 ms
apart and drifting by 20 ppm. Errors of the two must be at most 1.05 times those of the one."""
import os
import subprocess
import sys
import time

SECONDS, OFFSET_MS, DRIFT_PPM, MAX_RATIO = 15.0, 5.0, 20.0, 1.05
SKIPPED = 77


def in_namespace() -> None:
    """Once more within a user and network namespace of its own, or the end of the test."""
    if os.environ.get("PHAROS_IN_NAMESPACE"):
        return
    command = ["unshare", "--user", "--map-root-user", "--net", "--mount", "--fork", "--kill-child"]
    probe = command + ["sh", "-c", "ip link add name pharos0 type veth peer name pharos1"]
    try:
        result = subprocess.run(probe, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        print("skipped: unshare is not installed")
        sys.exit(SKIPPED)
    if result.returncode != 0:
        print("skipped: network namespaces are not permitted here:", result.stderr.strip())
        sys.exit(SKIPPED)
    environment = dict(os.environ, PHAROS_IN_NAMESPACE="1")
    sys.exit(subprocess.run(command + sys.argv, env=environment, check=False).returncode)


def shell(*lines: str, within: int | None = None) -> None:
    enter = ["nsenter", "--target", str(within), "--net"] if within else []
    for line in lines:
        subprocess.run(enter + line.split(), check=True)


def interface(name: str, address: str, within: int | None = None) -> None:
    shell("ip link set lo up", f"ip address add {address}/24 dev {name}", f"ip link set {name} up multicast on",
          f"ip route add 224.0.0.0/4 dev {name}", within=within)


def result_of(process: subprocess.Popen) -> dict[str, float]:
    text, _ = process.communicate(timeout=SECONDS + 30.0)
    if process.returncode != 0:
        sys.exit(f"a daemon ended with {process.returncode}: {text}")
    words = next(line for line in text.splitlines() if line.startswith("states ")).split()
    return {name: float(value) for name, value in zip(words[::2], words[1::2])}


def main() -> None:
    in_namespace()
    program = sys.argv[1]
    other = subprocess.Popen(["unshare", "--net", "sleep", "120"])  # holds the second namespace
    third = subprocess.Popen(["unshare", "--net", "sleep", "120"])  # of the one computer
    time.sleep(0.5)
    shell("ip link add name pharos0 type veth peer name pharos1", f"ip link set pharos1 netns {other.pid}")
    interface("pharos0", "10.77.0.1")
    interface("pharos1", "10.77.0.2", within=other.pid)
    shell("ip link set lo up multicast on", "ip route add 224.0.0.0/4 dev lo", within=third.pid)

    def start(role: str, within: int | None, *clock: float) -> subprocess.Popen:
        enter = ["nsenter", "--target", str(within), "--net"] if within else []
        arguments = [program, role, str(start_ns), str(SECONDS), *(str(value) for value in clock)]
        return subprocess.Popen(enter + arguments, stdout=subprocess.PIPE, text=True)

    try:
        start_ns = time.time_ns() + 1_000_000_000
        cameras = start("cameras", other.pid, OFFSET_MS, DRIFT_PPM)
        chaser = start("chaser", None, 0.0, 0.0)
        one = start("one", third.pid, 0.0, 0.0)
        two_computers, one_computer = result_of(chaser), result_of(one)
        cameras.communicate(timeout=30.0)
    finally:
        other.kill()
        third.kill()
    print("one computer ", one_computer)
    print("two computers", two_computers)
    for error in ("position_mm", "rotation_deg"):
        ratio = two_computers[error] / one_computer[error]
        print(f"{error}: {ratio:.3f} times that of one computer")
        if not ratio <= MAX_RATIO:
            sys.exit(f"{error} is beyond {MAX_RATIO} times that of one computer")
    if not 0.0 < two_computers["remote_sigma_us"] < 1000.0:
        sys.exit("the clocks' relation was not measured")


main()
