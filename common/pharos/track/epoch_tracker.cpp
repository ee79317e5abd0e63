// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/epoch_tracker.hpp"

#include <algorithm>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/warm.hpp"

namespace pharos::track {
namespace {

std::uint8_t flags_of(const Cycle& cycle, bool calibrated) {
  std::uint8_t flags = 0;
  if (!calibrated) flags |= kEpochUncalibrated;
  if (cycle.sweep_flags & lighthouse::kSweepFlashWeak) flags |= kEpochFlashWeak;
  if (cycle.sweep_flags & lighthouse::kSweepPeriodNominal) flags |= kEpochPeriodNominal;
  if (cycle.sweep_flags & lighthouse::kSweepLockPoor) flags |= kEpochLockPoor;
  return flags;
}

// Mean instant of the hits for which `use(i)` holds; the cycle's last flash when there are none.
template <class Use>
std::int64_t mean_ticks(const IdealObservations& ideal, std::int64_t fallback_ticks, Use use) {
  std::int64_t sum = 0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < ideal.observations.size(); ++i) {
    if (!use(i)) continue;
    sum += ideal.raw[i].time_ticks - fallback_ticks;
    ++count;
  }
  return count == 0 ? fallback_ticks : fallback_ticks + sum / count;
}

bool residual_credible(const LighthousePoseEstimate& estimate, double sigma_rad) {
  const double ratio = estimate.residual_rms / sigma_rad;
  const int freedom = estimate.observations - pose::kPoseUnknowns;
  return ratio * ratio * estimate.observations <= pose::credible_chi2(freedom);
}

}  // namespace

EpochTracker::EpochTracker(const Target& target, const TrackOptions& options) : target_(target), options_(options) {}

void EpochTracker::set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration) {
  if (station < kMaxStations) stations_[station].calibration = calibration;
}

bool EpochTracker::after_long_dark(const lighthouse::Sweep& sweep) const {
  return newest_flash_ticks_ && sweep.flash.start_ticks - *newest_flash_ticks_ > kLongestDarkTicks;
}

void EpochTracker::forget_stations() {
  stations_ = {};
  newest_flash_ticks_.reset();
}

std::optional<EpochResult> EpochTracker::push(const lighthouse::Sweep& sweep) {
  if (sweep.flash.station >= kMaxStations) return std::nullopt;
  if (after_long_dark(sweep)) forget_stations();
  newest_flash_ticks_ = std::max(newest_flash_ticks_.value_or(sweep.flash.start_ticks), sweep.flash.start_ticks);
  Station& station = stations_[sweep.flash.station];
  const auto axis = static_cast<std::size_t>(index_of(sweep.flash.axis));
  const lighthouse::SmoothedFlash smoothed = station.smoother[axis].push(sweep);
  if (sweep.flash.skip) return std::nullopt;
  const lighthouse::SweepBearings bearings =
      options_.smooth_flashes ? lighthouse::bearings_of(sweep, smoothed) : lighthouse::bearings_of(sweep);
  const auto cycle =
      station.assembler.push(sweep.flash.station, sweep.flash.axis, sweep.flash.start_ticks, sweep.flags, bearings);
  if (!cycle) return std::nullopt;
  return answer(station, *cycle);
}

std::optional<EpochResult> EpochTracker::flush() {
  for (Station& station : stations_) {
    if (const auto cycle = station.assembler.flush()) return answer(station, *cycle);
  }
  return std::nullopt;
}

const LighthouseFromBody* EpochTracker::fresh_pose(const Station& station, const Cycle& cycle) const {
  if (!station.last_pose) return nullptr;
  const double age_s = ticks_to_seconds(cycle.last_flash_ticks - station.last_pose_ticks);
  return age_s >= 0.0 && age_s < options_.prior_max_age_s ? &*station.last_pose : nullptr;
}

Result<pose::Solution, pose::Refusal> EpochTracker::solve_from(const LighthouseFromBody* prior) const {
  if (options_.warm_start && prior != nullptr) {
    if (const auto warm = pose::solve_warm(target_, ideal_.observations, options_.solve, *prior)) return *warm;
  }
  return pose::solve(target_, ideal_.observations, options_.solve, prior);
}

Result<pose::Solution, pose::Refusal> EpochTracker::solve(Station& station, const Cycle& cycle, EpochResult& result) {
  const lighthouse::StationCalibration* calibration = station.calibration ? &*station.calibration : nullptr;
  const LighthouseFromBody* last = fresh_pose(station, cycle);
  ideal_ = ideal_observations(cycle, target_, calibration, options_.form, nullptr, options_.warm_start);
  auto solution = solve_from(options_.warm_start ? last : nullptr);
  if (!solution && solution.error() == pose::Refusal::kTooFewSensors && last != nullptr) {
    solution = solve_from(last);
    if (solution) result.flags |= kEpochPrior;
  }
  if (!solution || !ideal_.guessed) return solution;
  // The first pose tells the angle across, which single hits were corrected without.
  const LighthouseFromBody first = solution->estimate.pose;
  ideal_ = ideal_observations(cycle, target_, calibration, options_.form, &first, options_.warm_start);
  return solve_from(options_.warm_start || (result.flags & kEpochPrior) != 0 ? &first : nullptr);
}

TrackedBearing EpochTracker::bearing(std::size_t index) const {
  const pose::Observation& observation = ideal_.observations[index];
  TrackedBearing tracked{ideal_.raw[index], observation.axis, observation.theta_rad, used_[index], 0.0};
  const SensorPlacement* sensor = find_sensor(target_, observation.sensor);
  if (answered_pose_ && sensor != nullptr) {
    const lighthouse::ThetaPair predicted = lighthouse::ideal_thetas(*answered_pose_ * sensor->position_m);
    tracked.residual_rad = observation.theta_rad - predicted[observation.axis];
  }
  return tracked;
}

EpochResult EpochTracker::answer(Station& station, const Cycle& cycle) {
  EpochResult result;
  result.station = cycle.station;
  result.flags = flags_of(cycle, station.calibration.has_value());
  const auto solution = solve(station, cycle, result);
  if (ideal_.left_out > 0) result.flags |= kEpochOutliers;
  used_.reset();
  answered_pose_.reset();
  if (!solution) {
    result.observations = static_cast<int>(ideal_.observations.size());
    result.time_ticks = mean_ticks(ideal_, cycle.last_flash_ticks, [](std::size_t) { return true; });
    result.pose = solution.error();
    return result;
  }
  used_ = solution->used;
  answered_pose_ = solution->estimate.pose;
  if (used_.count() < ideal_.observations.size()) result.flags |= kEpochOutliers;
  if (!residual_credible(solution->estimate, options_.solve.sigma_rad)) result.flags |= kEpochResidualHigh;
  result.observations = solution->estimate.observations;
  result.time_ticks = mean_ticks(ideal_, cycle.last_flash_ticks, [this](std::size_t i) { return used_[i]; });
  LighthousePoseEstimate estimate = solution->estimate;
  estimate.time_ns = ticks_to_nanoseconds(result.time_ticks);
  // An answer that leant on the pose before it, or has a rival, is nothing for the next one to lean on.
  if ((result.flags & kEpochPrior) == 0 && !estimate.ambiguous()) {
    station.last_pose = estimate.pose;
    station.last_pose_ticks = result.time_ticks;
  }
  result.pose = estimate;
  return result;
}

}  // namespace pharos::track
