// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/pose/solve.hpp"

namespace pharos::host {

// The counters of a target's pipeline. X(name, what it counts)
#define PHAROS_TARGET_COUNTERS(X)                                                        \
  X(sweeps, "sweeps received")                                                           \
  X(sweeps_bad_station, "sweeps dropped: a slot position that there is not")             \
  X(cycles_ok, "cycles with a pose")                                                     \
  X(cycles_ambiguous, "cycles with two poses that fit nearly as well")                   \
  X(cycles_stale, "cycles answered, not sent: measurement older than publish.max_age_s") \
  X(cycles_no_clock, "cycles answered, not sent: target's clock not mapped to UTC yet")  \
  X(cycles_not_finite, "cycles answered, not sent: not finite (a bug of ours)")          \
  X(cycles_wrong_target, "cycles refused: the board is not the expected one")            \
  X(board_poses, "poses solved on board")                                                \
  X(ootx_payloads, "OOTX payloads received")                                             \
  X(ootx_unreadable, "OOTX payloads of no known protocol")                               \
  X(calibrations_taken, "calibrations taken into use")                                   \
  X(station_pairs_refused, "times the stations did not stand as the calibration says")   \
  X(raw_edges, "edges received in diagnostic mode")                                      \
  X(target_restarts, "times the target's clock started anew")                            \
  X(unexpected_events, "good frames of types that only a host sends")

struct TargetCounters {
#define PHAROS_X(name, text) std::int64_t name = 0;
  PHAROS_TARGET_COUNTERS(PHAROS_X)
#undef PHAROS_X
  /// Cycles without a pose, by pose::Refusal.
  std::array<std::int64_t, 16> refused{};

  void count_refusal(pose::Refusal refusal) {
    const auto index = static_cast<std::size_t>(refusal);
    ++refused[index < refused.size() ? index : 0];
  }
};

/// Calls visit(name, value, what it counts) for every named counter.
template <class Visitor>
void for_each_counter(const TargetCounters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name, text);
  PHAROS_TARGET_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

}  // namespace pharos::host
