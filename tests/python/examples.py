# SPDX-License-Identifier: Apache-2.0
"""Messages for the tests, with a value in every field."""

import pharos


def pose(sequence=7, **changes):
    message = pharos.pose_t()
    message.utime, message.utime_sigma_us, message.latency_us, message.sequence = 1_700_000_000_123_456, 40, 1500, sequence
    message.source, message.station_or_camera, message.target = "lighthouse/pharosd", "BEC08E38", "target12"
    message.parent_frame, message.child_frame = "lighthouse", "body"
    message.status, message.valid, message.flags = "ok", True, "prior|fused"
    message.position_m = [0.25, -0.5, 2.0]
    message.orientation_wxyz = [0.5, -0.5, 0.5, 0.5]
    message.covariance = [float(k) for k in range(36)]
    message.observations = 23
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def status():
    counter = pharos.counter_t()
    counter.name, counter.value = "poses_published", 12
    source = pharos.source_status_t()
    source.source, source.state, source.counters, source.counter_count = "lighthouse/pharosd", "ok", [counter], 1
    message = pharos.status_t()
    message.state, message.sources, message.source_count = "ok", [source], 1
    return message


def bearings():
    bearing = pharos.bearing_t()
    message = pharos.bearings_t()
    message.bearings, message.count = [bearing, bearing], 2
    return message


def preview():
    message = pharos.preview_t()
    message.source, message.view, message.status = "ring2/bow", "left", "ok"
    message.width_px, message.height_px, message.format = 640, 480, "jpeg"
    message.data = bytes(range(200))
    message.size = len(message.data)
    return message


def every_type():
    return [pose(), status(), bearings(), pharos.spin_t(), pharos.pointing_t(), preview()]


def fields(message):
    """A message as nested plain values, for comparison."""
    if hasattr(message, "__slots__"):
        return {name: fields(getattr(message, name)) for name in message.__slots__}
    if isinstance(message, (list, tuple)):
        return [fields(value) for value in message]
    return message
