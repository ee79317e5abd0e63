// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/daemon/stereo/spin_window.hpp"
#include "host/daemon/stereo/stereo_pair.hpp"
#include "host/publish/health.hpp"
#include "host/publish/stereo_report.hpp"

namespace pharos::host {

/// What a stage of an estimator took.
struct StageTime {
  const char* stage = "";
  std::int64_t ns = 0;
};

/// What became of one pair.
struct PairResult : MeasurementOutcome {
  Ring2Pose pose;
  std::optional<SpinResult> spin;  // where one is due
  std::vector<StageTime> stages;
  NamedCounts figures;  // of the estimator so far; empty where it tells none
};

/// Pairs to poses, in a thread of its own; pairs come in the order of their times.
class PairEstimator {
 public:
  virtual ~PairEstimator() = default;
  /// Throws for nothing that a pair may hold; must be fit for the next pair if it does throw.
  virtual PairResult measure(const StereoPair& pair) = 0;
  /// A pose of this system's type, for answers without one: the type is what tells on which channel they go.
  virtual Ring2Pose no_pose() const = 0;
};

}  // namespace pharos::host
