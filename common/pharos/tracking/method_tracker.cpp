// SPDX-License-Identifier: Apache-2.0
#include "pharos/tracking/method_tracker.hpp"

#include "pharos/tracking/unknown_station.hpp"

namespace pharos::tracking {

MethodTracker::MethodTracker(const Target& target, const MethodOptions& options)
    : target_(target), tracker_(make(target, options)) {}

MethodTracker::Either MethodTracker::make(const Target& target, const MethodOptions& options) {
  if (options.method == Method::kEpoch) {
    return Either(std::in_place_type<track::EpochTracker>, target, options.track);
  }
  return Either(std::in_place_type<motion::MotionTracker>, target,
                motion::motion_options(options.track, options.systematic, options.limits));
}

void MethodTracker::set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration,
                                    lighthouse::CalibrationSource source) {
  if (auto* motion = std::get_if<motion::MotionTracker>(&tracker_)) {
    motion->set_calibration(station, calibration, source);
  } else {
    std::get<track::EpochTracker>(tracker_).set_calibration(station, calibration);
  }
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
  return widened(std::visit([&](auto& tracker) { return tracker.push(sweep); }, tracker_));
}

// The covariance of a single cycle includes only the noise of its bearings; the error of an uncalibrated station is
// much larger and is added here.
std::optional<track::EpochResult> MethodTracker::widened(std::optional<track::EpochResult> result) const {
  const auto* epoch = std::get_if<track::EpochTracker>(&tracker_);
  if (epoch == nullptr || !result || !result->pose || (result->flags & track::kEpochUncalibrated) == 0) return result;
  const auto unknown = rotor_covariance(result->pose->pose, *epoch, target_, motion::kFactorySpread);
  if (unknown) {
    result->pose->covariance += *unknown;
  } else {
    result->pose = pose::Refusal::kTooUncertain;
  }
  return result;
}

std::optional<track::EpochResult> MethodTracker::flush() {
  return widened(std::visit([](auto& tracker) { return tracker.flush(); }, tracker_));
}

std::size_t MethodTracker::bearing_count() const {
  return std::visit([](const auto& tracker) { return tracker.bearing_count(); }, tracker_);
}

track::TrackedBearing MethodTracker::bearing(std::size_t index) const {
  return std::visit([&](const auto& tracker) { return tracker.bearing(index); }, tracker_);
}

}  // namespace pharos::tracking
