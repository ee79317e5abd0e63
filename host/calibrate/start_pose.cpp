// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/start_pose.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "pharos/pose/solve.hpp"
#include "pharos/track/ideal_observations.hpp"

namespace pharos::calibrate {
namespace {

// The interval in the form of one cycle of the tracker. A bearing's index in the interval is stored as its time.
struct StationaryCycle {
  track::Cycle cycle;
  std::vector<MeanBearing*> place;
};

StationaryCycle cycle_of(StationaryAverage& interval, std::size_t station) {
  StationaryCycle result;
  for (RotorView& view : interval.rotors) {
    if (view.station != station) continue;
    const auto axis = static_cast<std::size_t>(index_of(view.axis));
    result.cycle.has_sweep[axis] = true;
    for (MeanBearing& bearing : view.bearings) {
      lighthouse::Bearing raw;
      raw.sensor = bearing.sensor;
      raw.theta_rad = bearing.raw_rad;
      raw.time_ticks = static_cast<std::int64_t>(result.place.size());
      if (result.cycle.bearings[axis].push_back(raw)) result.place.push_back(&bearing);
    }
  }
  return result;
}

void remove_unused(StationaryAverage& interval, std::size_t station, const std::vector<const MeanBearing*>& used) {
  for (RotorView& view : interval.rotors) {
    if (view.station != station) continue;
    std::vector<MeanBearing> kept;
    for (const MeanBearing& bearing : view.bearings) {
      if (std::find(used.begin(), used.end(), &bearing) != used.end()) kept.push_back(bearing);
    }
    view.bearings = std::move(kept);
  }
}

}  // namespace

std::optional<StartPose> start_pose(StationaryAverage& interval, std::size_t station, const Target& target,
                                    const lighthouse::StationCalibration& calibration, lighthouse::ModelForm form,
                                    double sigma_rad) {
  const StationaryCycle whole = cycle_of(interval, station);
  pose::SolveOptions options;
  options.sigma_rad = sigma_rad;
  auto ideal = std::make_unique<track::IdealObservations>(
      track::ideal_observations(whole.cycle, target, &calibration, form, nullptr));
  auto solution = pose::solve(target, ideal->observations, options);
  if (solution && ideal->guessed) {
    const LighthouseFromBody first = solution->estimate.pose;
    *ideal = track::ideal_observations(whole.cycle, target, &calibration, form, &first);
    solution = pose::solve(target, ideal->observations, options);
  }
  if (!solution) return std::nullopt;
  std::vector<const MeanBearing*> used;
  for (std::size_t i = 0; i < ideal->observations.size(); ++i) {
    if (solution->used[i]) used.push_back(whole.place[static_cast<std::size_t>(ideal->raw[i].time_ticks)]);
  }
  remove_unused(interval, station, used);
  return StartPose{solution->estimate.pose, solution->estimate.ambiguous()};
}

}  // namespace pharos::calibrate
