# SPDX-License-Identifier: Apache-2.0
"""Bytes of a channel to the type that they are of."""

import io
import struct
from typing import NamedTuple

from . import TYPES
from .values import check_values

# By the fingerprint with which LCM begins a message.
BY_FINGERPRINT = {kind._get_packed_fingerprint(): kind for kind in TYPES.values()}


class Message(NamedTuple):
    channel: str
    time_s: float  # of arrival (of an event in a log: of its logging), seconds since 1970
    message: object  # pose_t, status_t, ...


def decode(data):
    """The message in `data`, whatever its type. ValueError if it is none of Pharos' types, not whole, or has values that
    no pharosd sends (numbers that are not finite, a quaternion that is no turn, a negative variance)."""
    kind = BY_FINGERPRINT.get(bytes(data[:8]))
    if kind is None:
        raise ValueError("not a message of Pharos, or of another version of a type")
    stream = io.BytesIO(data)
    try:
        message = kind.decode(stream)
    except (struct.error, IndexError, OverflowError) as error:
        raise ValueError(f"{kind.__name__}: cut off or damaged: {error}") from None
    if kind is TYPES["preview_t"] and len(message.data) != message.size:  # lcm-gen takes what is there
        raise ValueError("preview_t: cut off or damaged: its picture is not as long as it says")
    if stream.tell() != len(data):
        raise ValueError(f"{kind.__name__}: {len(data) - stream.tell()} bytes too many")
    check_values(kind.__name__, message)
    return message
