# SPDX-License-Identifier: Apache-2.0
"""Whether the values of a message are some that a pharosd sends. Anyone who can reach LCM can send others."""

import math

# A hundred thousand kilometres: beyond it nothing is at close range.
MAX_VALUE = 1e8
# Of a quaternion that was sent as doubles.
UNIT_TOLERANCE = 1e-3
# Of a message that is not valid only these are looked at; the rest is 0 there.
IN_EVERY_MESSAGE = ("utime", "sequence")
QUATERNIONS = ("orientation_wxyz", "second_orientation_wxyz")
SIZES = {"pose_t": 6, "target_state_t": 12, "spin_t": 3}  # of the covariance


def check_values(name, message):
    """ValueError with the field's name where `message`, of the type `name`, has values that no pharosd sends."""
    for field in IN_EVERY_MESSAGE:
        if getattr(message, field, 0) < 0:
            raise ValueError(f"{name}: impossible {field}")
    if not getattr(message, "valid", False):
        return
    for field in message.__slots__:
        value = getattr(message, field)
        if field.startswith("second_") and not message.has_second:
            continue
        if isinstance(value, float) or _is_list_of_floats(value):
            _check_numbers(name, field, value if isinstance(value, (tuple, list)) else (value,))
        if field in QUATERNIONS and abs(math.hypot(*value) - 1.0) > UNIT_TOLERANCE:
            raise ValueError(f"{name}: impossible {field}: not of length one")
    size = SIZES.get(name, 0)
    if any(message.covariance[k * size + k] < 0.0 for k in range(size)):
        raise ValueError(f"{name}: impossible covariance: a negative variance")


def _is_list_of_floats(value):
    return isinstance(value, (tuple, list)) and bool(value) and isinstance(value[0], float)


def _check_numbers(name, field, values):
    if not all(abs(value) <= MAX_VALUE for value in values):  # false for nan
        raise ValueError(f"{name}: impossible {field}")
