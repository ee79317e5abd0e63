// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/fusion/protection.hpp"
#include "pharos/fusion/source_monitor.hpp"

namespace pharos::fusion {

struct FusionCounters {
  std::uint64_t used = 0;
  std::uint64_t gated = 0;
  std::uint64_t ambiguous = 0;  // both solutions fit: used for nothing
  std::uint64_t exclusions = 0;
  std::uint64_t readmissions = 0;
  std::uint64_t conflicts = 0;
  std::uint64_t hand_overs = 0;     // a source that came (back)
  std::uint64_t limited_steps = 0;  // its measurements taken with less weight, so that the state moves 1 sigma at most
  std::uint64_t unresolved = 0;     // contradictions that nothing could judge
  std::uint64_t refuted = 0;        // tracks that two excluded sources contradicted together
  std::uint64_t restarts = 0;       // the track was lost or contradicted by its only source
  double largest_hand_over_sigma = 0.0;
};

/// Before there is a track: the poses that the first measurements allow, both solutions of an ambiguous one.
struct Search {
  std::uint32_t sources = 0;  // bits: whose measurements were used
  int accepted = 0;
  int rejected_run = 0;
  std::array<double, 2> score{};  // -2 log likelihood
};

/// Two sources that contradict each other.
struct Suspects {
  bool active = false;
  std::uint8_t first = 0, second = 0;
  std::int64_t agree_since_ns = 0;  // 0: they do not
};

/// A contradiction that nothing else can judge: the only source that tells the whole pose contradicted the track, or
/// what all of them say fits no solution. The track was wrong, or they are.
struct Unresolved {
  bool active = false;
  bool restarted = false;     // the track of before is gone: the source cannot confirm itself
  std::uint8_t source = 0;    // where !restarted: the one that contradicts the track
  std::int64_t since_ns = 0;  // the last contradiction
};

/// Everything that changes: a late measurement starts again from a copy of it.
struct FusionState {
  bool tracking = false;
  bool lost = false;  // there was a track
  std::int64_t time_ns = 0;
  std::int64_t last_used_ns = 0;
  Filter main;
  /// One without each source. While searching, `main` and without[0] are the two candidates.
  std::array<Filter, kMaxSources> without;
  /// Of each source (second index) in the solution without another.
  std::array<std::array<InnovationMean, kMaxSources>, kMaxSources> innovation_means;
  std::array<SourceMonitor, kMaxSources> monitors;
  /// Where each source's feature is in the target: as set, or of a relative source as its first pose tells.
  std::array<Pose<frame::Target, FeatureFrame>, kMaxSources> T_target_feature;
  Search search;
  Suspects suspects;
  Unresolved unresolved;
  FusionCounters counters;
};

}  // namespace pharos::fusion
