// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace pharos::host {

// Outcomes of the frames given to a camera's pipeline: each is counted once. X(name, what it counts)
#define PHAROS_TOF_COUNTERS(X)                                                          \
  X(frames_ok, "frames with a pose")                                                    \
  X(frames_ambiguous, "frames with two poses that fit nearly as well")                  \
  X(frames_refused, "frames without a pose; refused.<stage> says why")                  \
  X(frames_stale, "frames older than publish.max_age_s, before or after the estimator") \
  X(frames_no_clock, "frames while the camera's clock was not mapped to UTC")           \
  X(frames_time_back, "frames whose time was not after that of the one before")         \
  X(frames_wrong_size, "frames of another size than the camera file's")                 \
  X(frames_not_finite, "frames answered, not sent: not finite (a bug of ours)")

struct TofCounters {
#define PHAROS_X(name, text) std::int64_t name = 0;
  PHAROS_TOF_COUNTERS(PHAROS_X)
#undef PHAROS_X
  /// Refused frames by the stage that failed.
  std::map<std::string, std::int64_t> refused;
};

template <class Visitor>
void for_each_counter(const TofCounters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name);
  PHAROS_TOF_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

}  // namespace pharos::host
