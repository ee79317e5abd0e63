#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: compare.py HOST TARGET: compares the core's results on two machines, as printed by vectors/.

A line is a key and its values: integers and bytes (b...) must be equal bit for bit, reals (x and their 64 bits) within
the bound of their key. Says for every kind of real how many are equal and how far the others lie apart. Exit code 1
where anything else differs.
"""

import math
import struct
import sys
from collections import defaultdict

# Largest difference: absolute, or as a part of the line's largest value; a hundred times what was measured. Values
# without a bound here must be equal bit for bit: all that are computed by sums, products, quotients and square roots in
# an order fixed by the source. The others involve sines and arctangents, or Eigen, whose order of additions depends on
# the machine.
BOUNDS = {
    "pose": ("absolute", 1e-11),  # elements of a rotation; metres
    "second": ("absolute", 1e-11),
    "residual": ("relative", 1e-9),
    "covariance": ("relative", 1e-9),
    "precision": ("relative", 1e-10),
    "precision_of": ("relative", 1e-10),
    "station": ("absolute", 1e-14),  # rad
    "tof_ellipse": ("absolute", 1e-11),  # px
    "tof_ring": ("absolute", 1e-13),  # m
    "tof_box": ("absolute", 1e-5),  # m; cells vote in single precision
    "tof_connector": ("absolute", 1e-9),  # m; starts at the box
    "tof_pose": ("absolute", 1e-13),  # m; elements of a rotation
    "tof_covariance": ("relative", 1e-8),  # its rotation part is by central differences
}


def real(token):
    return struct.unpack(">d", bytes.fromhex(token[1:]))[0]


def is_real(token):
    return token.startswith("x")


class Reals:
    """Differences of one kind of real."""

    def __init__(self):
        self.count = self.equal = 0
        self.largest = 0.0

    def add(self, host, target, scale):
        self.count += 1
        if host == target:
            self.equal += 1
            return
        difference = abs(real(host) - real(target)) / scale
        self.largest = math.inf if math.isnan(difference) else max(self.largest, difference)


def scale_of(kind, tokens):
    if kind == "absolute":
        return 1.0
    return max((abs(real(t)) for t in tokens if is_real(t)), default=0.0) or 1.0


def compare(host_lines, target_lines):
    """-> (complaints, {key: Reals})"""
    complaints = []
    reals = defaultdict(Reals)
    if not host_lines:
        complaints.append("no results at all")
    if len(host_lines) != len(target_lines):
        complaints.append(f"{len(host_lines)} lines from the host, {len(target_lines)} from the target")
    for number, (host, target) in enumerate(zip(host_lines, target_lines), 1):
        ours, theirs = host.split(), target.split()
        key = ours[0] if ours else ""
        exact = [t for t in ours if not is_real(t)], [t for t in theirs if not is_real(t)]
        if [is_real(t) for t in ours] != [is_real(t) for t in theirs] or exact[0] != exact[1]:
            complaints.append(f"line {number} differs:\n  host   {host}\n  target {target}")
            continue
        scale = scale_of(BOUNDS.get(key, ("absolute", 0.0))[0], ours)
        for a, b in zip(ours, theirs):
            if is_real(a):
                reals[key].add(a, b, scale)
    for key, seen in reals.items():
        kind, bound = BOUNDS.get(key, ("absolute", 0.0))
        if seen.largest > bound or (bound == 0.0 and seen.equal != seen.count):
            complaints.append(f"{key}: {kind} difference of {seen.largest:.2g}, allowed {bound:.2g}")
    return complaints, reals


def main(host_path, target_path):
    with open(host_path, encoding="ascii") as host, open(target_path, encoding="ascii") as target:
        host_lines, target_lines = host.read().splitlines(), target.read().splitlines()
    complaints, reals = compare(host_lines, target_lines)
    print(f"{len(host_lines)} lines; reals by kind: equal to the last bit / all, largest difference of the others")
    for key, seen in reals.items():
        kind, bound = BOUNDS.get(key, ("absolute", 0.0))
        print(f"  {key:13} {seen.equal:6} / {seen.count:6}  {seen.largest:8.2g} {kind} (allowed {bound:.2g})")
    for complaint in complaints[:10]:
        print(complaint)
    print(f"FAILED: {len(complaints)} differences" if complaints else "integers and bytes are equal bit for bit")
    return 1 if complaints else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
