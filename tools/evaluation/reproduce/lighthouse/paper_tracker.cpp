// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/paper_tracker.hpp"

#include <array>

#include "pharos/base/units.hpp"
#include "pharos/pose/precision.hpp"

namespace pharos::tools::paper002 {
namespace {

track::TrackOptions cycles_alone() {
  track::TrackOptions options;
  options.smooth_flashes = false;
  options.solve.look_for_second = false;
  return options;
}

// Sensors with both angles; the first hit of a sweep counts.
std::vector<SensorAngles> angles_of(const track::EpochTracker& cycle, const Target& target) {
  std::array<std::array<std::optional<double>, kAxes>, kMaxSensors> theta;
  for (std::size_t i = 0; i < cycle.bearing_count(); ++i) {
    const track::TrackedBearing bearing = cycle.bearing(i);
    auto& place = theta[bearing.raw.sensor][static_cast<std::size_t>(bearing.axis)];
    if (!place) place = bearing.ideal_theta_rad;
  }
  std::vector<SensorAngles> angles;
  for (const SensorPlacement& sensor : target) {
    const auto& [x, y] = theta[sensor.sensor];
    if (x && y) angles.push_back({sensor.sensor, Vector2(*x, *y)});
  }
  return angles;
}

}  // namespace

PaperTracker::PaperTracker(const Target& target, double rho)
    : target_(target), rho_(rho), cycles_(target, cycles_alone()) {}

std::optional<track::EpochResult> PaperTracker::solved(std::optional<track::EpochResult> cycle) {
  if (!cycle) return cycle;
  angles_ = angles_of(cycles_, target_);
  last_ = solve_by_paper(target_, angles_);
  cycle->observations = static_cast<int>(kAxes * angles_.size());
  if (!last_) {
    cycle->pose = angles_.size() < static_cast<std::size_t>(pose::kMinSensorsAlone) ? pose::Refusal::kTooFewSensors
                                                                                    : pose::Refusal::kNotConverged;
    return cycle;
  }
  LighthousePoseEstimate estimate;
  estimate.pose = last_->pose;
  estimate.iterations = last_->iterations;
  estimate.observations = cycle->observations;
  pose::SensorSet sensors;
  for (const SensorAngles& one : angles_) sensors.set(one.sensor);
  if (const auto precision = pose::precision_of(target_, estimate.pose, sensors, rho_)) {
    estimate.covariance = precision->unit_covariance * kPaperSigma_rad * kPaperSigma_rad;
    estimate.adop_deg_per_rad = precision->adop_deg_per_rad;
    estimate.pdop_m_per_rad = precision->pdop_m_per_rad;
  }
  cycle->pose = estimate;
  return cycle;
}

}  // namespace pharos::tools::paper002
