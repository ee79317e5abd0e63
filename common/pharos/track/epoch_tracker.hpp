// SPDX-License-Identifier: Apache-2.0
#pragma once

// INTERFACE AGREED, implementation follows: sweeps of one target in, one pose a station and cycle out (the paper's way).
#include <array>
#include <cstdint>
#include <optional>

#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::track {

struct TrackOptions {
  pose::SolveOptions solve;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  bool smooth_flashes = true;
  /// Start from the last pose of the same station when it is younger than this; 0 = every cycle from nothing.
  double prior_max_age_s = 0.5;
};

/// Words said about one cycle's answer; a bit set.
enum EpochFlag : std::uint8_t {
  kEpochUncalibrated = 1,   // no calibration of this station was known: angles as the ideal station's
  kEpochFlashWeak = 2,      // as in Sweep
  kEpochPeriodNominal = 4,  // as in Sweep
  kEpochOutliers = 8,       // hits were left out (reflections, or they fit no rigid body)
  kEpochPrior = 16,         // started from the last pose
  kEpochLockPoor = 32,      // as in Sweep
};

/// One cycle of one station (its x and its y sweep): a pose, or why there is none.
struct EpochResult {
  std::uint8_t station = 0;
  std::uint8_t flags = 0;       // of EpochFlag
  std::int64_t time_ticks = 0;  // mean time of the hits used (of all hits where refused)
  int observations = 0;         // angles used; offered where refused
  Result<LighthousePoseEstimate, pose::Refusal> pose = pose::Refusal::kTooFewSensors;
};

class EpochTracker {
 public:
  EpochTracker(const Target& target, const TrackOptions& options);
  /// Calibration of the station in this slot position, from now on.
  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration);
  /// A cycle is complete with the second of its two sweeps, or when the other one did not come.
  std::optional<EpochResult> push(const lighthouse::Sweep& sweep);
  /// End of the input: the cycle still held back, if any (call until empty).
  std::optional<EpochResult> flush();
};

}  // namespace pharos::track
