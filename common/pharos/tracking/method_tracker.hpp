// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "pharos/motion/motion_tracker.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::tracking {

/// How poses are computed: every hit at its own time, one pose per sweep (common/pharos/motion), or each cycle
/// separately, one pose per cycle, as in paper 002 (common/pharos/track).
enum class Method : std::uint8_t { kMotion, kEpoch };

struct MethodOptions {
  Method method = Method::kMotion;
  track::TrackOptions track;                                          // both methods: noise, solver, station model
  motion::SystematicErrors systematic = motion::kUncalibratedErrors;  // method motion
  motion::UncertaintyLimits limits;                                   // method motion
};

/// The tracker of the chosen method; see there. Some 125 KiB.
class MethodTracker {
 public:
  MethodTracker(const Target& target, const MethodOptions& options);

  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration,
                       lighthouse::CalibrationSource source);
  void clear_calibration(std::uint8_t station);
  /// Not used by method epoch.
  void set_relative(const std::optional<motion::StationRelative>& relative);
  /// Whether measurements of both stations contradicted the pose of set_relative(), which is then no longer used.
  bool relative_pose_rejected() const;
  void forget_stations();
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep);
  std::optional<track::EpochResult> flush();
  /// Number of hits of the last result, including those left out.
  std::size_t bearing_count() const;
  track::TrackedBearing bearing(std::size_t index) const;

 private:
  using Either = std::variant<track::EpochTracker, motion::MotionTracker>;
  static Either make(const Target& target, const MethodOptions& options);

  std::optional<track::EpochResult> widened(std::optional<track::EpochResult> result) const;

  Target target_;
  Either tracker_;
};

}  // namespace pharos::tracking
