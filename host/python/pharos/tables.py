# SPDX-License-Identifier: Apache-2.0
"""The tables of Pharos (pharos-tables(5)) as numpy arrays."""

import gzip
import sys

import numpy as np

# Columns that are words even where all of their values look like numbers.
TEXT_COLUMNS = frozenset({
    "station_id", "axis", "flags", "status", "image", "frame", "payload_hex", "kind", "feature", "view", "problem", "pose",
    "parameter", "told", "name", "reason", "method", "system", "what", "unit", "remark", "published", "ours"})
# Columns of counter readings: whole numbers beyond the 53 bits of a float.
INTEGER_ENDINGS = ("_ticks", "utime", "_us")
POSITION = ("tx_m", "ty_m", "tz_m")
QUATERNION = ("qw", "qx", "qy", "qz")
GZIP_MAGIC = b"\x1f\x8b"


def _text_of(path):
    if path == "-":
        data = sys.stdin.buffer.read()
    else:
        with open(path, "rb") as file:
            data = file.read()
    if data[:2] == GZIP_MAGIC:
        data = gzip.decompress(data)
    return data.decode("utf-8")


def _column(path, name, values):
    if name in TEXT_COLUMNS:
        return np.array(values, dtype=str)
    try:
        if name.endswith(INTEGER_ENDINGS) and all(values):
            return np.array([int(value) for value in values], dtype=np.int64)
        return np.array([float(value) if value else np.nan for value in values], dtype=np.float64)
    except ValueError:
        # A column of a later version that is not in the list above.
        if any(_is_number(value) for value in values):
            raise ValueError(f"{path}: column {name} has numbers and words") from None
        return np.array(values, dtype=str)


def _is_number(value):
    try:
        float(value)
    except ValueError:
        return False
    return True


def read_table(path):
    """A table (CSV, plain or gzip, "-": standard input) as a dict from the column's name to its array: float64, with nan
    for an empty field; int64 for counters (`..._ticks`, utime) without empty fields; str for words.

    A last line without its line end was cut off while it was written and is left out, as in the programs, unless it has
    all of its fields. ValueError names the file and the line of a row with another number of fields."""
    text = _text_of(path)
    lines = text.splitlines()
    if not lines or not lines[0]:
        raise ValueError(f"{path}: no header row")
    names = lines[0].lstrip("\ufeff").split(",")
    if len(set(names)) != len(names):
        raise ValueError(f"{path}:1: a column twice")
    rows = [line.split(",") for line in lines[1:]]
    if rows and len(rows[-1]) != len(names) and not text.endswith("\n"):
        rows.pop()
    for number, row in enumerate(rows, 2):
        if len(row) != len(names):
            raise ValueError(f"{path}:{number}: {len(row)} fields under {len(names)} columns")
    columns = zip(*rows) if rows else ((),) * len(names)
    return {name: _column(path, name, values) for name, values in zip(names, columns)}


def read_tum(path):
    """A trajectory of `pharos slam` (timestamp tx ty tz qx qy qz qw) with the columns of a table of poses."""
    rows = [line.split() for line in _text_of(path).splitlines() if line.strip() and not line.startswith("#")]
    for number, row in enumerate(rows, 1):
        if len(row) != 8:
            raise ValueError(f"{path}: row {number}: {len(row)} numbers, not 8")
    values = np.array(rows, dtype=np.float64).reshape(-1, 8)
    order = {"time_s": 0, "tx_m": 1, "ty_m": 2, "tz_m": 3, "qx": 4, "qy": 5, "qz": 6, "qw": 7}
    return {name: values[:, index] for name, index in order.items()}


def rotation_matrices(wxyz):
    """Rotation matrices, N x 3 x 3, of quaternions w, x, y, z, N x 4 (or 3 x 3 of one); nan where one is nan."""
    q = np.asarray(wxyz, dtype=np.float64)
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def pose_arrays(table):
    """R, N x 3 x 3, and t, N x 3 in metres, of a table of poses: p_parent = R p_child + t. nan where a row was refused."""
    quaternions = np.stack([table[name] for name in QUATERNION], axis=-1)
    return rotation_matrices(quaternions), np.stack([table[name] for name in POSITION], axis=-1)


def covariance_matrix(message):
    """The covariance of a pose_t, 6 x 6, rotation (rad) before translation (m), in the parent frame."""
    return np.array(message.covariance, dtype=np.float64).reshape(6, 6)
