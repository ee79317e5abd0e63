// SPDX-License-Identifier: Apache-2.0
#include "pharos/tracking/method_tracker.hpp"

namespace pharos::tracking {

MethodTracker::MethodTracker(const Target& target, const MethodOptions& options) : tracker_(make(target, options)) {}

MethodTracker::Either MethodTracker::make(const Target& target, const MethodOptions& options) {
  if (options.method == Method::kEpoch) {
    return Either(std::in_place_type<track::EpochTracker>, target, options.track);
  }
  return Either(std::in_place_type<motion::MotionTracker>, target,
                motion::motion_options(options.track, options.systematic, options.limits));
}

void MethodTracker::set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration) {
  std::visit([&](auto& tracker) { tracker.set_calibration(station, calibration); }, tracker_);
}

void MethodTracker::clear_calibration(std::uint8_t station) {
  std::visit([&](auto& tracker) { tracker.clear_calibration(station); }, tracker_);
}

void MethodTracker::set_relative(const std::optional<motion::StationRelative>& relative) {
  if (auto* motion = std::get_if<motion::MotionTracker>(&tracker_)) motion->set_relative(relative);
}

bool MethodTracker::relative_pose_rejected() const {
  const auto* motion = std::get_if<motion::MotionTracker>(&tracker_);
  return motion != nullptr && motion->pair().survey_refused();
}

void MethodTracker::forget_stations() {
  std::visit([](auto& tracker) { tracker.forget_stations(); }, tracker_);
}

std::optional<track::EpochResult> MethodTracker::push(const lighthouse::Sweep& sweep) {
  return std::visit([&](auto& tracker) { return tracker.push(sweep); }, tracker_);
}

std::optional<track::EpochResult> MethodTracker::flush() {
  return std::visit([](auto& tracker) { return tracker.flush(); }, tracker_);
}

std::size_t MethodTracker::bearing_count() const {
  return std::visit([](const auto& tracker) { return tracker.bearing_count(); }, tracker_);
}

track::TrackedBearing MethodTracker::bearing(std::size_t index) const {
  return std::visit([&](const auto& tracker) { return tracker.bearing(index); }, tracker_);
}

}  // namespace pharos::tracking
