// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/epoch_tracker.hpp"

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

// In sigmas: a bearing that was corrected by less would move the pose by at most a third of it.
constexpr double kSameBearing = 0.2;

// Refusals that need a search.
bool took_search(pose::Refusal refusal) {
  return refusal == pose::Refusal::kNotConverged || refusal == pose::Refusal::kPoorFit ||
         refusal == pose::Refusal::kBehindStation || refusal == pose::Refusal::kSearchLimit;
}

bool residual_plausible(const LighthousePoseEstimate& estimate, double sigma_rad) {
  const double ratio = estimate.residual_rms / sigma_rad;
  const int freedom = estimate.observations - pose::kPoseUnknowns;
  return ratio * ratio * estimate.observations <= pose::chi2_threshold(freedom);
}

}  // namespace

EpochTracker::EpochTracker(const Target& target, const TrackOptions& options) : target_(target), options_(options) {}

void EpochTracker::set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration) {
  if (station < kMaxStations) stations_[station].calibration = calibration;
}

void EpochTracker::clear_calibration(std::uint8_t station) {
  if (station < kMaxStations && stations_[station].calibration) stations_[station] = {};
}

void EpochTracker::forget_stations() { stations_ = {}; }

[[gnu::noinline]] const Cycle* EpochTracker::take(Station& station, const lighthouse::Sweep& sweep,
                                                  const lighthouse::SmoothedFlash& smoothed, bool may_complete) {
  const lighthouse::Flash& flash = sweep.flash;
  const auto bearings = [&] {
    if (!options_.smooth_flashes) return lighthouse::bearings_of(sweep);
    return options_.warm_start ? lighthouse::fixed_bearings_of(sweep, smoothed)
                               : lighthouse::bearings_of(sweep, smoothed);
  };
  return station.assembler.add(flash.station, flash.axis, flash.start_ticks, sweep.flags, bearings(), may_complete);
}

std::optional<EpochResult> EpochTracker::push(const lighthouse::Sweep& sweep) {
  const lighthouse::Flash& flash = sweep.flash;
  if (flash.station >= kMaxStations) return std::nullopt;
  Station& station = stations_[flash.station];
  const auto axis = static_cast<std::size_t>(index_of(flash.axis));
  const lighthouse::SmoothedFlash smoothed = station.smoother[axis].push(sweep);
  if (flash.skip) return std::nullopt;
  return complete(station, sweep, smoothed);
}

std::optional<EpochResult> EpochTracker::complete(Station& station, const lighthouse::Sweep& sweep,
                                                  const lighthouse::SmoothedFlash& smoothed) {
  // Values between here and the solver stay off the stack as far as possible: a soft core has little of it.
  const Cycle* pushed_out = station.assembler.close_before(sweep.flash.axis, sweep.flash.start_ticks);
  const Cycle* due = pushed_out != nullptr ? pushed_out : take(station, sweep, smoothed, true);
  std::optional<EpochResult> result;
  if (due != nullptr) answer(station, *due, result.emplace());
  if (pushed_out != nullptr) take(station, sweep, smoothed, false);
  return result;
}

std::optional<EpochResult> EpochTracker::flush() {
  std::optional<EpochResult> result;
  for (Station& station : stations_) {
    const auto cycle = station.assembler.flush();
    if (!cycle) continue;
    answer(station, *cycle, result.emplace());
    break;
  }
  return result;
}

const LighthouseFromBody* EpochTracker::fresh_pose(const Station& station, const Cycle& cycle, double max_age_s) {
  if (!station.last_pose) return nullptr;
  const double age_s = ticks_to_seconds(cycle.last_flash_ticks - station.last_pose_ticks);
  return age_s >= 0.0 && age_s < max_age_s ? &*station.last_pose : nullptr;
}

void EpochTracker::correct(const Station& station, const Cycle& cycle, const LighthouseFromBody* pose) {
  ideal_observations(cycle, target_, station.calibration ? &*station.calibration : nullptr, options_.form, pose,
                     options_.warm_start, ideal_);
}

// Sensors of the target among the cycle's bearings.
int EpochTracker::sensors_seen() const {
  std::bitset<kMaxSensors> seen;
  for (const pose::Observation& o : ideal_.observations) {
    if (o.sensor < kMaxSensors && find_sensor(target_, o.sensor) != nullptr) seen[o.sensor] = true;
  }
  return static_cast<int>(seen.count());
}

void EpochTracker::solve_from(const LighthouseFromBody* prior, Station& station, const Cycle& cycle,
                              SolveResult& answer) const {
  if (options_.warm_start && sensors_seen() >= pose::kMinSensorsAlone) {
    if (prior != nullptr && solve_warm_from(*prior, answer)) return;
    if (cycle.last_flash_ticks < station.search_cooldown_until_ticks) {
      answer = pose::Refusal::kSearchLimit;
      return;
    }
  }
  answer = pose::solve(target_, ideal_.observations, options_.solve, prior);
  if (!answer && took_search(answer.error())) {
    station.search_cooldown_until_ticks = cycle.last_flash_ticks + options_.search_cooldown_ticks;
  }
}

[[gnu::noinline]] bool EpochTracker::solve_warm_from(const LighthouseFromBody& prior, SolveResult& answer) const {
  const auto warm = pose::solve_warm(target_, ideal_.observations, options_.solve, prior);
  if (warm) answer = *warm;
  return warm.has_value();
}

void EpochTracker::solve(Station& station, const Cycle& cycle, EpochResult& result, SolveResult& answer) {
  const LighthouseFromBody* last = fresh_pose(station, cycle, options_.prior_max_age_s);
  const LighthouseFromBody* warm = options_.warm_start ? fresh_pose(station, cycle, options_.warm_max_age_s) : nullptr;
  correct(station, cycle, warm);
  const bool enough = sensors_seen() >= pose::kMinSensorsAlone;
  solve_from(enough ? warm : nullptr, station, cycle, answer);
  if (!answer && answer.error() == pose::Refusal::kTooFewSensors && last != nullptr) {
    solve_from(last, station, cycle, answer);
    if (answer) result.flags |= kEpochPrior;
  }
  if (!answer || !ideal_.guessed) return;
  // The first pose gives the angle across, which single hits were corrected without, or by an older one.
  const LighthouseFromBody first = answer->estimate.pose;
  if (options_.warm_start) {
    const double change_rad = correct_guessed(cycle, target_, *station.calibration, options_.form, first, ideal_);
    if (change_rad < kSameBearing * options_.solve.sigma_rad) return;
  } else {
    correct(station, cycle, &first);
  }
  solve_from(options_.warm_start || (result.flags & kEpochPrior) != 0 ? &first : nullptr, station, cycle, answer);
}

TrackedBearing EpochTracker::bearing(std::size_t index) const {
  const pose::Observation& observation = ideal_.observations[index];
  TrackedBearing tracked{ideal_.raw[index], observation.axis, observation.theta_rad, used_[index], 0.0};
  const SensorPlacement* sensor = find_sensor(target_, observation.sensor);
  if (solved_pose_ && sensor != nullptr) {
    const lighthouse::ThetaPair predicted = lighthouse::ideal_thetas(*solved_pose_ * sensor->position_m);
    tracked.residual_rad = observation.theta_rad - predicted[observation.axis];
  }
  return tracked;
}

[[gnu::noinline]] void EpochTracker::accept(Station& station, const Cycle& cycle, const pose::Solution& solution,
                                            EpochResult& result) {
  used_ = solution.used;
  solved_pose_ = solution.estimate.pose;
  if (used_.count() < ideal_.observations.size()) result.flags |= kEpochOutliers;
  if (!residual_plausible(solution.estimate, options_.solve.sigma_rad)) result.flags |= kEpochResidualHigh;
  result.observations = solution.estimate.observations;
  result.time_ticks = mean_ticks(ideal_, cycle.last_flash_ticks, [this](std::size_t i) { return used_[i]; });
  // A result that needed the previous pose, or has a second solution, must not be the prior of the next one.
  if ((result.flags & kEpochPrior) == 0 && !solution.estimate.ambiguous()) {
    station.last_pose = solution.estimate.pose;
    station.last_pose_ticks = result.time_ticks;
  }
  result.pose = solution.estimate;
  result.pose->time_ns = ticks_to_nanoseconds(result.time_ticks);
}

[[gnu::noinline]] void EpochTracker::refuse(const Cycle& cycle, pose::Refusal why, EpochResult& result) const {
  result.observations = static_cast<int>(ideal_.observations.size());
  result.time_ticks = mean_ticks(ideal_, cycle.last_flash_ticks, [](std::size_t) { return true; });
  result.pose = why;
}

void EpochTracker::answer(Station& station, const Cycle& cycle, EpochResult& result) {
  result.station = cycle.station;
  result.flags = flags_of(cycle, station.calibration.has_value());
  // One axis alone gives no pose, and on a slow core the corrections without a partner cost more than a pose.
  const bool abandoned = options_.warm_start && (cycle[Axis::kX].empty() || cycle[Axis::kY].empty());
  SolveResult solution = abandoned ? pose::Refusal::kDegenerate : pose::Refusal::kNotConverged;
  if (abandoned) {
    ideal_observations(cycle, target_, nullptr, options_.form, nullptr, true, ideal_);  // input of the solver
  } else {
    solve(station, cycle, result, solution);
  }
  if (ideal_.left_out > 0) result.flags |= kEpochOutliers;
  used_.reset();
  solved_pose_.reset();
  if (solution) {
    accept(station, cycle, *solution, result);
  } else {
    refuse(cycle, solution.error(), result);
  }
}

}  // namespace pharos::track
