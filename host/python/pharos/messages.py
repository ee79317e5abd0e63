# SPDX-License-Identifier: Apache-2.0
"""Bytes of a channel to the type that they are of."""

import io
import struct
from typing import NamedTuple

from .bearings_t import bearings_t
from .pointing_t import pointing_t
from .pose_t import pose_t
from .spin_t import spin_t
from .status_t import status_t

# Types that are messages of their own, by the fingerprint with which LCM begins a message.
TYPES = {kind._get_packed_fingerprint(): kind for kind in (pose_t, bearings_t, pointing_t, spin_t, status_t)}


class Message(NamedTuple):
    channel: str
    time_s: float  # of arrival (of an event in a log: of its logging), seconds since 1970
    message: object  # pose_t, bearings_t, pointing_t, spin_t or status_t


def decode(data):
    """The message in `data`, whatever its type. ValueError if it is none of Pharos' types or not whole."""
    kind = TYPES.get(bytes(data[:8]))
    if kind is None:
        raise ValueError("not a message of Pharos, or of another version of a type")
    stream = io.BytesIO(data)
    try:
        message = kind.decode(stream)
    except (struct.error, IndexError, OverflowError) as error:
        raise ValueError(f"{kind.__name__}: cut off or damaged: {error}") from None
    if stream.tell() != len(data):
        raise ValueError(f"{kind.__name__}: {len(data) - stream.tell()} bytes too many")
    return message
