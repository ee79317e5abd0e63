// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "host/config/daemon_config.hpp"
#include "pharos/motion/motion_tracker.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {

/// The tracker that a target's configuration asks for.
class TargetTracker {
 public:
  explicit TargetTracker(const TargetConfig& config);

  /// Everything known of stations and body is forgotten.
  void restart();
  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration);
  /// Both stations are known by name: the calibration may tell how they stand to one another.
  void set_stations(std::uint32_t first_id, std::uint32_t second_id);
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep);
  /// End of the input: what is still held back (call until empty).
  std::optional<track::EpochResult> flush();
  std::size_t bearing_count() const;
  track::TrackedBearing bearing(std::size_t index) const;
  /// What both stations see contradicts how they stand by the calibration, which is not used.
  bool relative_pose_rejected() const;

 private:
  using Either = std::variant<track::EpochTracker, motion::MotionTracker>;
  static Either make(const TargetConfig& config);

  std::optional<calibrate::CalibratedPair> pair_;
  std::unique_ptr<Either> tracker_;  // some 100 KiB
};

}  // namespace pharos::host
