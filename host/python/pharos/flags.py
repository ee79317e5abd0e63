# SPDX-License-Identifier: Apache-2.0
"""What a program that steers has to look at before it uses a pose."""

import time

# A pose with one of these is right within its sigmas as far as is known, and no basis for steering: a station whose own
# errors are not known yet, data of a target that contradict themselves, times that may have gone back.
NOT_FOR_STEERING = frozenset({"uncalibrated", "suspect", "clock_set"})


def flag_words(message):
    """The flags of a message as a set of words."""
    return frozenset(filter(None, message.flags.split("|")))


def for_steering(pose, max_age_s, now_s=None):
    """Whether a pose_t may steer: valid, not ambiguous, none of NOT_FOR_STEERING, and measured at most max_age_s ago
    (and not in the future by more than that). now_s: seconds since 1970, this computer's clock if not given."""
    now_s = time.time() if now_s is None else now_s
    fresh = abs(now_s - pose.utime * 1e-6) <= max_age_s
    return bool(pose.valid) and pose.status == "ok" and fresh and not (flag_words(pose) & NOT_FOR_STEERING)
