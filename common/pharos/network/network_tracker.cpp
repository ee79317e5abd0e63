// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pharos/network/station_consensus.hpp"

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
// Chi-squared of what lies between the filter's position or velocity and what two stations tell at once.
constexpr double kStrayedChi2 = 14.0;
// So many times the variance of what two stations tell at once: the filter goes on from there.
constexpr double kVague = 9.0;
constexpr double kBetterFix = 4.0;  // times the filter's variance: it is the position's while its sweeps all agree
// A target that tells its range is asked so often while its light fits: the position's fix is a third of the cost.
constexpr double kAsk_s = 0.03;
constexpr double kConfirming_m = 0.06;  // a position that is known less well confirms nothing
// All four planes of two stations show the body within this time: a cycle of LH1 is 33 ms.
constexpr double kCycle_s = 0.035;
// What an attitude of less than 60 ms may be off by: its rate is not known, and a flat target's tilt least of all.
constexpr double kUnconfirmed_rad = 0.15;
// A lone hit of a target of several sensors cannot be told from a reflection.
constexpr std::size_t kSensorsForPair = 3;
// About any axis, 1 sigma: an attitude that may be the mirrored one, as far as some of the sensors' middle is
// concerned.
constexpr double kMirrored_rad = 1.0;
// Hits that do not fit the others of their sweep: an attitude that leaves out so many is wrong. Averaged over so many.
constexpr double kAttitudeSuspect = 0.125, kAttitudeDoubted = 0.25, kLeftOutSweeps = 8.0;
// Of the last sweeps so large a fraction at which the rates were forgotten: two stations that contradict each other
// move the filter in turn. The onset of a motion is one or two.
constexpr double kMaxResets = 0.1, kResetSweeps = 32.0;
// Sweeps in a row that exclude a station while another one fits, and that readmit it.
constexpr int kForExclusion = 25, kForReadmission = 50;
// How often all stations are asked whether one contradicts the others, and how often more than not in favour it is
// excluded.
constexpr double kConsensus_s = 0.02;
// Until one is excluded, contradictions in so many checks end the answers.
constexpr int kDissents = 6, kContradictions = 10, kContradictionWeight = 3;
// How long sweeps are kept for a start, and how often the present pose is compared with what stations alone say.
constexpr double kRecent_s = 0.12;
constexpr double kCheck_s = 0.5, kCheckAmbiguous_s = 0.03;

// A state that no body has: followed without light that fits, its rates run away.
bool holds_a_body(const NetworkState& state) {
  return state.pose.is_finite() && state.rate.tail<3>().norm() < kFastest_m_s &&
         state.covariance.block<3, 3>(kPoseAt + 3, kPoseAt + 3).trace() < kLost_m * kLost_m;
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
  if (taken && shown_by_two_stations()) fixed_s_ = now_s;
  // A small target is followed without two stations only as long as all light fits.
  if (!fix_ && (!taken || attitude_doubted())) fixed_s_ = -1e9;
  if (contradicted_) {
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
  StationWatch& station = watch_[sweep.station];
  if (linearised.sensors > 0) {
    const double left = 1.0 - static_cast<double>(linearised.hits()) / linearised.sensors;
    left_out_ += (left - left_out_) / kLeftOutSweeps;
  }
  bool good = fits(linearised);
  const bool reset = !good && !station.excluded && ++refused_in_row_ >= kRefusedForReset;
  if (!station.excluded) resets_ += ((reset ? 1.0 : 0.0) - resets_) / kResetSweeps;
  if (reset) {
    filter_.reset_rates();
    ++counters_.rate_resets;
    refused_in_row_ = 0;
    linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
    good = fits(linearised);
  }
  watch(sweep.station, good, now_s);
  if (!good || station.excluded) {
    refuse(linearised);
    return false;
  }
  filter_.correct(linearised);
  saw(linearised);
  accepted_s_ = now_s;
  refused_in_row_ = 0;
  return true;
}

// A station whose sweeps contradict while those of others fit was moved, or its entry in the file is wrong. Where one
// other fits, that one may be it.
void NetworkTracker::watch(std::size_t station, bool fits, double time_s) {
  StationWatch& own = watch_[station];
  own.refused = fits ? 0 : own.refused + 1;
  own.accepted = fits ? own.accepted + 1 : 0;
  const auto fitting = std::count_if(watch_.begin(), watch_.end(), [&](const StationWatch& other) {
    return &other != &own && !other.excluded && other.accepted >= kForExclusion && time_s - other.seen_s < kFresh_s;
  });
  if (!own.excluded && own.refused >= kForExclusion && fitting > 0) {
    (fitting > 1 ? own.excluded : own.disputed) = true;
    if (fitting > 1) ++counters_.exclusions;
  } else if (own.excluded && own.accepted >= kForReadmission) {
    own.excluded = false;
    ++counters_.readmissions;
  }
  if (own.excluded || own.accepted >= kForReadmission) own.disputed = false;
  if (fits) own.seen_s = time_s;
}

// A target that does not tell its range is answered only where two stations agree on its position.
bool NetworkTracker::disputed() const {
  if (!tells_range(target_, options_.noise)) return false;
  return resets_ > kMaxResets ||
         std::any_of(watch_.begin(), watch_.end(), [](const StationWatch& station) { return station.disputed; });
}

// One that was moved draws the filter away, so that others do not fit it either: they are compared without it.
void NetworkTracker::check_consensus(double time_s) {
  consensus_s_ = time_s;
  const Consensus consensus =
      consensus_of(used_recent(), stations_, target_, filter_.mean().pose, options_.noise.unstated);
  contradictions_ =
      std::clamp(contradictions_ + (consensus.contradiction ? kContradictionWeight : -1), 0, kContradictions);
  if (contradictions_ == kContradictions) contradicted_ = true;
  if (contradictions_ == 0) contradicted_ = false;
  for (std::size_t s = 0; s < stations_.size(); ++s) {
    StationWatch& station = watch_[s];
    station.dissents = consensus.dissenting == s ? station.dissents + 1 : std::max(0, station.dissents - 1);
    if (station.excluded || station.dissents < kDissents) continue;
    station.excluded = true;
    station.disputed = false;
    station.dissents = station.accepted = 0;
    contradictions_ = 0;
    contradicted_ = false;
    ++counters_.exclusions;
  }
}

// Of what lies between the filter and the position that two stations tell at once; `but_one`: where one sweep that may
// be a reflection explains it, it is none.
double NetworkTracker::apart_chi2(const PositionFix& fix, bool but_one) const {
  const NetworkState& state = filter_.mean();
  const StateMatrix& P = state.covariance;
  const Vector3 p = fix.position_m - state.pose.t, v = fix.velocity_m_s - state.rate.tail<3>();
  const Vector3 p1 = fix.by_one.head<3>(), v1 = fix.by_one.segment<3>(3);
  const double part = but_one ? 1.0 : 0.0;
  const Matrix3 Sp = P.block<3, 3>(kPoseAt + 3, kPoseAt + 3) + fix.position_covariance() + part * p1 * p1.transpose();
  const Matrix3 Sv =
      P.block<3, 3>(kRateAt + 3, kRateAt + 3) + fix.covariance.block<3, 3>(3, 3) + part * v1 * v1.transpose();
  return std::max(p.dot(Sp.inverse() * p), v.dot(Sv.inverse() * v));
}

// Where two stations see the body they tell at once where it is: a state that is elsewhere, as after a time with one
// station alone, whose range of a small target drifts, goes on from there.
bool NetworkTracker::strayed(bool taken) {
  fix_.reset();
  const bool sure = taken && confirmed(time_s_) && tells_range(target_, options_.noise);
  if (sure && time_s_ - asked_s_ < kAsk_s) return false;
  asked_s_ = time_s_;
  fix_ = fix_of(used_recent(), stations_, target_, filter_.mean(), time_s_, options_.noise, attitude_doubt_rad());
  if (!fix_) return false;
  const double fix_m2 = fix_->position_covariance().trace();
  const bool confirming = fix_m2 < kConfirming_m * kConfirming_m;
  if (confirming) fixed_s_ = time_s_;
  // A filter whose attitude is wrong refuses the light that would tell it the position, and all fits it that it does
  // not know.
  const bool vague = confirming && position_variance() > kVague * fix_->doubted_covariance().trace();
  if (confirming) saw(*fix_);
  if (!vague && apart_chi2(*fix_, true) < kStrayedChi2) return false;
  // A state that did not know its position has an attitude of one station alone, that may be the mirror of the true
  // one.
  if (vague && check_attitude()) return true;
  filter_.place(*fix_, vague);
  ++counters_.strays;
  // What did not fit the filter fits the position.
  if (vague || fix_->sound) forget_contradictions(*fix_);
  return true;
}

// After a gap both planes of two stations tell where the body is, and the filter how it moves: two sweeps more, which a
// position of their own needs, are not waited for. Only where every sensor was hit: with some of them the position
// leans on an attitude that may be mirrored by now.
bool NetworkTracker::shown_by_two_stations() const {
  if (!confirmed(time_s_) || attitude_suspect()) return false;
  const auto at_once = std::count_if(watch_.begin(), watch_.end(), [this](const StationWatch& station) {
    return !station.excluded && time_s_ - std::min(station.whole_s[0], station.whole_s[1]) < kCycle_s;
  });
  return at_once > 1 &&
         std::max(position_variance(), filter_.widest().position_variance()) < kConfirming_m * kConfirming_m;
}

// A filter takes what stations are wrong by for noise of each sweep, so that planes which contradict each other move it
// in turn: in motion it knows no more than all sweeps together, each at its own instant. At rest it does.
bool NetworkTracker::fix_is_better() const {
  if (!fix_ || tells_range(target_, options_.noise)) return false;
  return fix_->doubted_covariance().trace() < (fix_->sound ? kBetterFix : 1.0) * position_variance();
}

bool NetworkTracker::attitude_suspect() const {
  return left_out_ > kAttitudeSuspect && !tells_range(target_, options_.noise);
}

// True where other poses explain the recent sweeps better, and one of them is followed from now on.
bool NetworkTracker::check_attitude() {
  if (!confirmed(time_s_) || time_s_ - checked_s_ < kCheckAmbiguous_s) return false;
  const std::uint64_t starts = counters_.starts;
  check_alternatives(time_s_, true);
  return counters_.starts > starts;
}

// Then the light that a wrong attitude takes draws the position of a small target away.
bool NetworkTracker::attitude_doubted() const {
  return left_out_ > kAttitudeDoubted && !tells_range(target_, options_.noise);
}

// Of a flat target it may be the mirrored one while it is new, or leaves out hits. The sensors of a sweep that lacks
// some are then elsewhere: 12 mm off at a stated 4.
double NetworkTracker::attitude_doubt_rad() const {
  const bool open = attitude_suspect() || (!confirmed(time_s_) && !tells_range(target_, options_.noise));
  return open ? kMirrored_rad : 0.0;
}

double NetworkTracker::position_variance() const { return filter_.mean().position_variance(); }

bool NetworkTracker::confirmed(double time_s) const { return time_s - started_s_ >= kConfirmed_s; }

// The recent sweeps of stations that are not excluded.
SweepView NetworkTracker::used_recent() const {
  SweepView out;
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    if (!watch_[recent_[i].station].excluded) out.push_back(&recent_[i]);
  }
  return out;
}

SweepView NetworkTracker::all_recent() const {
  SweepView out;
  for (std::size_t i = 0; i < recent_.size(); ++i) out.push_back(&recent_[i]);
  return out;
}

}  // namespace pharos::network
