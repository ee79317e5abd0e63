// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "pharos/track/epoch_tracker.hpp"
#include "tools/evaluation/reproduce/lighthouse/paper_pose.hpp"

namespace pharos::tools::paper002 {

/// Each cycle by the paper's method alone. Cycles and the stations' calibration come from an EpochTracker, whose poses
/// are not used.
class PaperTracker {
 public:
  PaperTracker(const Target& target, double rho);

  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration) {
    cycles_.set_calibration(station, calibration);
  }
  /// As EpochTracker: the covariance is H sigma^2 of (18), with the paper's sigma.
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep) { return solved(cycles_.push(sweep)); }
  std::optional<track::EpochResult> flush() { return solved(cycles_.flush()); }

  /// The last cycle solved again, its descent begun at `start`.
  std::optional<PaperPose> solved_from(const LighthouseFromBody& start) const {
    return descend(target_, angles_, start);
  }
  /// Of the last cycle.
  const std::optional<PaperPose>& last() const { return last_; }

 private:
  std::optional<track::EpochResult> solved(std::optional<track::EpochResult> cycle);

  Target target_;
  double rho_;
  track::EpochTracker cycles_;
  std::vector<SensorAngles> angles_;
  std::optional<PaperPose> last_;
};

}  // namespace pharos::tools::paper002
