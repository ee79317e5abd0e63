// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace pharos::host {

// Outcomes of the pairs given to a system's pipeline: each is counted once. X(name, what it counts)
#define PHAROS_STEREO_COUNTERS(X)                                                                 \
  X(pairs_ok, "pairs with a pose")                                                                \
  X(pairs_ambiguous, "pairs with two poses that fit nearly as well")                              \
  X(pairs_refused, "pairs without a pose; refused.<reason> says why")                             \
  X(pairs_stale, "pairs older than publish.max_age_s, before or after the estimator")             \
  X(pairs_dropped, "pairs that gave way to newer ones: the estimator is slower than the cameras") \
  X(pairs_not_finite, "pairs answered, not sent: not finite (a bug of ours)")                     \
  X(spins_not_finite, "spins answered, not sent: not finite (a bug of ours)")

struct StereoCounters {
#define PHAROS_X(name, text) std::int64_t name = 0;
  PHAROS_STEREO_COUNTERS(PHAROS_X)
#undef PHAROS_X
  std::map<std::string, std::int64_t> refused;
};

template <class Visitor>
void for_each_counter(const StereoCounters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name);
  PHAROS_STEREO_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

}  // namespace pharos::host
