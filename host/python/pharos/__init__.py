# SPDX-License-Identifier: Apache-2.0
"""Pharos for Python: the LCM types (pose_t, ...), a receiver of live messages, LCM logs and tables as numpy.

    import pharos
    for received in pharos.Receiver():
        print(received.channel, received.message.status)
    poses = pharos.read_table("poses.csv.gz")

Reading tables needs numpy, which is imported at the first use.
"""

import importlib
import pkgutil

# Every type of the build, first: lcm-gen's code finds one type in another as an attribute of this package.
TYPES = {}
for _module in pkgutil.iter_modules(__path__):
    if _module.name.endswith("_t"):
        TYPES[_module.name] = getattr(importlib.import_module(f"{__name__}.{_module.name}"), _module.name)
globals().update(TYPES)

from .flags import NOT_FOR_STEERING, flag_words, for_steering
from .log import read_log
from .messages import Message, decode
from .receiver import DEFAULT_URL, Receiver


def __getattr__(name):
    if name in ("read_table", "read_tum", "pose_arrays", "rotation_matrices", "covariance_matrix"):
        from . import tables

        return getattr(tables, name)
    raise AttributeError(f"module 'pharos' has no attribute '{name}'")
