// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "pharos/motion/motion_tracker.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::tracking {

/// How poses are found: every hit at its own instant, a pose a sweep (common/pharos/motion), or each cycle alone, a
/// pose a cycle, as in paper 002 (common/pharos/track).
enum class Method : std::uint8_t { kMotion, kEpoch };

struct MethodOptions {
  Method method = Method::kMotion;
  track::TrackOptions track;                                          // of both: noise, solver, station model
  motion::SystematicErrors systematic = motion::kUncalibratedErrors;  // of motion
  motion::UncertaintyLimits limits;                                   // of motion
};

/// The tracker of the chosen method; what each does is said there. Some 125 KiB.
class MethodTracker {
 public:
  MethodTracker(const Target& target, const MethodOptions& options);

  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration,
                       lighthouse::CalibrationSource source);
  void clear_calibration(std::uint8_t station);
  /// Method epoch has no use for it.
  void set_relative(const std::optional<motion::StationRelative>& relative);
  /// What both stations see contradicts how they stand by set_relative(), which is not used any more.
  bool relative_pose_rejected() const;
  void forget_stations();
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep);
  std::optional<track::EpochResult> flush();
  /// The hits of the answer last given, those left out too.
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
