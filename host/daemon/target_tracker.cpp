// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/target_tracker.hpp"

#include "host/calibrate/calibration_file.hpp"

namespace pharos::host {

TargetTracker::TargetTracker(const TargetConfig& config)
    : pair_(config.calibrated_pair), tracker_(std::make_unique<Either>(make(config))) {}

TargetTracker::Either TargetTracker::make(const TargetConfig& config) {
  if (config.method == TrackMethod::kEpoch) return track::EpochTracker(config.target, config.track);
  return motion::MotionTracker(config.target, motion::motion_options(config.track, config.systematic, config.limits));
}

void TargetTracker::restart() {
  std::visit([](auto& tracker) { tracker.forget_stations(); }, *tracker_);
}

void TargetTracker::set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration) {
  std::visit([&](auto& tracker) { tracker.set_calibration(station, calibration); }, *tracker_);
}

void TargetTracker::set_stations(std::uint32_t first_id, std::uint32_t second_id) {
  auto* motion = std::get_if<motion::MotionTracker>(tracker_.get());
  if (motion == nullptr || !pair_) return;
  motion->set_relative(calibrate::relative_pose(*pair_, first_id, second_id));
}

std::optional<track::EpochResult> TargetTracker::push(const lighthouse::Sweep& sweep) {
  return std::visit([&](auto& tracker) { return tracker.push(sweep); }, *tracker_);
}

std::optional<track::EpochResult> TargetTracker::flush() {
  return std::visit([](auto& tracker) { return tracker.flush(); }, *tracker_);
}

std::size_t TargetTracker::bearing_count() const {
  return std::visit([](const auto& tracker) { return tracker.bearing_count(); }, *tracker_);
}

track::TrackedBearing TargetTracker::bearing(std::size_t index) const {
  return std::visit([&](const auto& tracker) { return tracker.bearing(index); }, *tracker_);
}

bool TargetTracker::relative_pose_rejected() const {
  const auto* motion = std::get_if<motion::MotionTracker>(tracker_.get());
  return motion != nullptr && motion->pair().survey_refused();
}

}  // namespace pharos::host
