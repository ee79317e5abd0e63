// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/daemon/stereo/spin_window.hpp"
#include "host/daemon/stereo/stereo_pair.hpp"
#include "host/preview/preview_picture.hpp"
#include "host/publish/health.hpp"
#include "host/publish/stereo_report.hpp"

namespace pharos::host {

/// Duration of a stage of an estimator.
struct StageTime {
  const char* stage = "";
  std::int64_t ns = 0;
};

/// Result of one pair.
struct PairResult : MeasurementOutcome {
  Ring2Pose pose;
  std::optional<SpinResult> spin;  // if one is due
  std::vector<StageTime> stages;
  NamedCounts figures;                   // of the estimator so far; empty if it has none
  std::vector<AnnotatedImage> pictures;  // if the pair asks for them
};

/// Computes poses from pairs, in a thread of its own; pairs come in the order of their times.
class PairEstimator {
 public:
  virtual ~PairEstimator() = default;
  /// Must not throw for any content of a pair. If it throws, the next pair must still work.
  virtual PairResult measure(const StereoPair& pair) = 0;
  /// A pose of this system's type, for results without a pose: the type determines their channel.
  virtual Ring2Pose no_pose() const = 0;
};

}  // namespace pharos::host
