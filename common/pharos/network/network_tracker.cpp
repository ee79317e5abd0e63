// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos::network {
namespace {

// A plane passes a target within this time; the next plane of any station that hits it is another sweep.
constexpr double kSweep_s = 0.004;
// Chi-squared of a sweep beyond every model: of n hits, n + this many times sqrt(2 n), and at least 25.
constexpr double kGateSigmas = 8.0, kMinGate = 25.0;
// Sweeps refused in a row until the rates are forgotten, and time without one that fits until the body is lost.
constexpr int kRefusedForReset = 2;
constexpr double kLost_s = 0.4;
constexpr double kFastest_m_s = 20.0, kLost_m = 2.0;
// A result waits this long after a start, until the rates are known.
constexpr double kConfirmed_s = 0.06;
// What an attitude of less than 60 ms may be off by: its rate is not known, and a flat target's tilt least of all.
constexpr double kUnconfirmed_rad = 0.15;
// A lone hit of a target of several sensors cannot be told from a reflection.
constexpr std::size_t kSensorsForPair = 3;
// Of the last sweeps so large a fraction at which the rates were forgotten: two stations that contradict each other
// move the filter in turn. The onset of a motion is one or two.
constexpr double kMaxResets = 0.1, kResetSweeps = 32.0;
// How often all stations are asked whether one contradicts the others.
constexpr double kConsensus_s = 0.02;
// How long sweeps are kept for a start, and how often the present pose is compared with what stations alone say.
constexpr double kRecent_s = 0.12;
constexpr double kCheck_s = 0.5;
// Sweeps over which the hits that do not fit the others of theirs are averaged.
constexpr double kLeftOutSweeps = 8.0;

// A state that no body has: followed without light that fits, its rates run away.
bool holds_a_body(const NetworkState& state) {
  return state.pose.is_finite() && state.rate.tail<3>().norm() < kFastest_m_s &&
         state.position_variance() < kLost_m * kLost_m;
}

// What sensors that are not where they are held to be turn a body by, whatever sees it: the same in every sweep.
Matrix3 placement_covariance(const Target& target, double sensor_m) {
  constexpr double kSmallest_m = 1e-3;  // along a line or at a point no turn is seen
  Vector3 centre_m = Vector3::Zero();
  for (const SensorPlacement& sensor : target) centre_m += sensor.position_m / static_cast<double>(target.size());
  Matrix3 inertia = kSmallest_m * kSmallest_m * Matrix3::Identity();
  for (const SensorPlacement& sensor : target) {
    const Matrix3 arm = skew(sensor.position_m - centre_m);
    inertia += arm.transpose() * arm;
  }
  return sensor_m * sensor_m * inertia.inverse();
}

double gate_of(int hits) { return std::max(kMinGate, hits + kGateSigmas * std::sqrt(2.0 * hits)); }

}  // namespace

NetworkTracker::NetworkTracker(const Stations& stations, const Target& target, const NetworkOptions& options)
    : stations_(stations),
      target_(target),
      options_(options),
      placement_covariance_(placement_covariance(target, options.noise.sensor_m)) {}

std::optional<NetworkResult> NetworkTracker::push(std::uint8_t number, std::size_t plane, const Hit& hit) {
  const Station* station = find_station(stations_, number);
  if (station == nullptr || plane >= kPlanes || !std::isfinite(hit.angle_rad) || !std::isfinite(hit.time_s)) {
    ++counters_.hits_unknown;
    return std::nullopt;
  }
  const auto place = static_cast<std::size_t>(station - stations_.begin());
  PlaneSweep& own = open_[place];
  const bool same = own.hits.empty() ||
                    (own.plane == plane && std::abs(hit.time_s - own.hits[0].time_s) < kSweep_s && !own.hits.full());
  // Light of another station may fall between this sweep's: each is closed when it is over.
  const std::optional<NetworkResult> out = close(same ? oldest_open(hit.time_s - kSweep_s) : &own);
  own.station = place;
  own.plane = plane;
  own.hits.push_back(hit);
  ++counters_.hits;
  return out;
}

std::optional<NetworkResult> NetworkTracker::flush() {
  return close(oldest_open(std::numeric_limits<double>::infinity()));
}

PlaneSweep* NetworkTracker::oldest_open(double before_s) {
  PlaneSweep* oldest = nullptr;
  for (PlaneSweep& open : open_) {
    if (open.hits.empty() || !(open.time_s() < before_s)) continue;
    if (oldest == nullptr || open.time_s() < oldest->time_s()) oldest = &open;
  }
  return oldest;
}

std::optional<NetworkResult> NetworkTracker::close(PlaneSweep* open) {
  if (open == nullptr) return std::nullopt;
  ++counters_.sweeps;
  const double now_s = open->time_s();
  // Sweeps of two stations may overlap: out of order by less than one of them.
  while (!recent_.empty() && (recent_.full() || recent_.front().time_s() < now_s - kRecent_s)) recent_.drop();
  recent_.push(*open);
  open->hits.clear();
  return process(recent_[recent_.size() - 1]);
}

NetworkResult NetworkTracker::process(const PlaneSweep& sweep) {
  const double now_s = sweep.time_s();
  if (running_ && now_s - accepted_s_ > kLost_s) {
    running_ = false;
    ++counters_.losses;
  }
  if (!running_) {
    if (!try_start(now_s)) return refused(sweep, pose::Refusal::kTooFewSensors);
    return from_fix(sweep, kUnconfirmed_rad);
  }
  if (now_s - consensus_s_ > kConsensus_s) check_consensus(now_s);
  LinearisedSweep linearised;
  const bool taken = take(sweep, linearised);
  if (!holds_a_body(filter_.mean())) {
    running_ = false;
    ++counters_.losses;
    return refused(sweep, pose::Refusal::kPoorFit);
  }
  const bool apart = 2 * linearised.hits() < linearised.sensors && !tells_range(target_, options_.noise);
  if (apart || attitude_suspect()) check_attitude();
  const bool settled = !strayed(taken) && confirmed(now_s);
  // A small target is followed without two stations only as long as all light fits.
  if (!fix_ && (!taken || attitude_doubted())) fixed_.forget();
  if (watch_.too_contradictory()) {
    ++counters_.sweeps_refused;
    return refused(sweep, pose::Refusal::kPoorFit);
  }
  if (!settled) return from_fix(sweep, confirmed(now_s) ? 0.0 : kUnconfirmed_rad);
  if (!taken) ++counters_.sweeps_refused;
  const double interval_s = ambiguous_ ? kCheckAmbiguous_s : kCheck_s;
  if (taken && now_s - checked_s_ > interval_s) check_alternatives(now_s, false);
  if (disputed()) return refused(sweep, pose::Refusal::kPoorFit);
  if (fix_is_better() || attitude_doubted()) {
    const NetworkResult fixed = from_fix(sweep, 0.0);
    if (fixed.pose.ok() || attitude_doubted()) return fixed;
  }
  return taken ? result(linearised) : refused(sweep, pose::Refusal::kPoorFit);
}

bool NetworkTracker::fits(const LinearisedSweep& sweep) const {
  const int min_hits = target_.size() >= kSensorsForPair ? 2 : 1;
  return sweep.hits() >= min_hits && 2 * sweep.hits() >= sweep.sensors &&
         filter_.widest_chi2(sweep) < gate_of(sweep.hits());
}

// Predicts to the sweep and adds it where it fits. False where it was not added.
bool NetworkTracker::take(const PlaneSweep& sweep, LinearisedSweep& linearised) {
  const double now_s = std::max(time_s_, sweep.time_s());
  filter_.predict(now_s - time_s_);
  time_s_ = now_s;
  linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
  counters_.hits_left_out += sweep.hits.size() - static_cast<std::size_t>(linearised.hits());
  const bool excluded = watch_.excluded(sweep.station);
  if (linearised.sensors > 0) {
    const double left = 1.0 - static_cast<double>(linearised.hits()) / linearised.sensors;
    left_out_ += (left - left_out_) / kLeftOutSweeps;
  }
  bool good = fits(linearised);
  const bool reset = !good && !excluded && ++refused_in_row_ >= kRefusedForReset;
  if (!excluded) resets_ += ((reset ? 1.0 : 0.0) - resets_) / kResetSweeps;
  if (reset) {
    filter_.reset_rates();
    ++counters_.rate_resets;
    refused_in_row_ = 0;
    linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
    good = fits(linearised);
  }
  watch_.watch(sweep.station, good, now_s, counters_);
  if (!good || watch_.excluded(sweep.station)) {
    planes_.refuse(linearised);
    return false;
  }
  filter_.correct(linearised);
  saw(linearised);
  accepted_s_ = now_s;
  refused_in_row_ = 0;
  return true;
}

// A target that does not tell its range is answered only where two stations agree on its position.
bool NetworkTracker::disputed() const {
  if (!tells_range(target_, options_.noise)) return false;
  return resets_ > kMaxResets || watch_.disputed();
}

// One that was moved draws the filter away, so that others do not fit it either: they are compared without it.
void NetworkTracker::check_consensus(double time_s) {
  consensus_s_ = time_s;
  watch_.take(consensus_of(used_recent(), stations_, target_, filter_.mean().pose, options_.noise.unstated), counters_);
}

bool NetworkTracker::confirmed(double time_s) const { return time_s - started_s_ >= kConfirmed_s; }

// The recent sweeps of stations that are not excluded.
SweepView NetworkTracker::used_recent() const {
  SweepView out;
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    if (!watch_.excluded(recent_[i].station)) out.push_back(&recent_[i]);
  }
  return out;
}

SweepView NetworkTracker::all_recent() const {
  SweepView out;
  for (std::size_t i = 0; i < recent_.size(); ++i) out.push_back(&recent_[i]);
  return out;
}

}  // namespace pharos::network
