// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::network {
namespace {

// A plane passes a target within this time; the next plane of any station that hits it is another sweep.
constexpr double kSweep_s = 0.004;
// Chi-squared of a sweep beyond every model: of n hits, n + this many times sqrt(2 n), and at least 25.
constexpr double kGateSigmas = 8.0, kMinGate = 25.0;
// Sweeps refused in a row until the rates are forgotten, and time without one that fits until the body is lost.
constexpr int kRefusedForReset = 2;
constexpr double kLost_s = 0.4;
constexpr double kUnseen_m = 0.1;
// How far the filter may be from what two stations tell at once, and what a body moves while they do.
// A result waits this long after a start, until the rates are known.
constexpr double kConfirmed_s = 0.06, kFastest_m_s = 2.0;
// How long a small target is followed without two stations that agree.
constexpr double kCoast_s = 0.05;
constexpr double kStrayed_m = 0.06, kTriangulation_s = 0.04;
// Sweeps in a row that exclude a station while another one fits, and that readmit it.
constexpr int kForExclusion = 25, kForReadmission = 50;
constexpr double kFresh_s = 0.1;
// How long sweeps are kept for a start, and how often the present pose is compared with what stations alone say.
constexpr double kRecent_s = 0.12;
constexpr double kCheck_s = 0.5, kCheckAmbiguous_s = 0.1;
constexpr double kSwitchCost = 18.0;
// Poses that turn less from each other are one.
constexpr double kSameRotation_rad = 0.2, kSamePosition_m = 0.05;
// A hit left out costs as much as an outlier anywhere within 20 mrad.
constexpr double kOutlierCost = 16.0;

double gate_of(int hits) { return std::max(kMinGate, hits + kGateSigmas * std::sqrt(2.0 * hits)); }

bool same_pose(const WorldFromBody& a, const WorldFromBody& b) {
  return rotation_angle_between(a.R, b.R) < kSameRotation_rad && (a.t - b.t).norm() < kSamePosition_m;
}

}  // namespace

NetworkTracker::NetworkTracker(const Stations& stations, const Target& target, const NetworkOptions& options)
    : stations_(stations), target_(target), options_(options) {}

std::optional<NetworkResult> NetworkTracker::push(std::uint8_t number, std::size_t plane, const Hit& hit) {
  const Station* station = find_station(stations_, number);
  if (station == nullptr || plane >= kPlanes || !std::isfinite(hit.angle_rad) || !std::isfinite(hit.time_s)) {
    ++counters_.hits_unknown;
    return std::nullopt;
  }
  const auto place = static_cast<std::size_t>(station - stations_.begin());
  std::optional<NetworkResult> out;
  const bool same = !open_.hits.empty() && open_.station == place && open_.plane == plane &&
                    std::abs(hit.time_s - open_.hits[0].time_s) < kSweep_s && !open_.hits.full();
  if (!same) {
    out = close();
    open_.station = place;
    open_.plane = plane;
  }
  open_.hits.push_back(hit);
  ++counters_.hits;
  return out;
}

std::optional<NetworkResult> NetworkTracker::flush() { return close(); }

std::optional<NetworkResult> NetworkTracker::close() {
  if (open_.hits.empty()) return std::nullopt;
  const PlaneSweep sweep = open_;
  open_.hits.clear();
  ++counters_.sweeps;
  const double now_s = sweep.time_s();
  // Sweeps of two stations may overlap: out of order by less than one of them.
  std::size_t old = 0;
  while (old < recent_.size() && (recent_[old].time_s() < now_s - kRecent_s || recent_.size() - old >= kRecentSweeps))
    ++old;
  if (old > 0) {
    std::copy(recent_.begin() + old, recent_.end(), recent_.begin());
    recent_.resize(recent_.size() - old);
  }
  recent_.push_back(sweep);
  return process(sweep);
}

NetworkResult NetworkTracker::refused(const PlaneSweep& sweep, pose::Refusal why) const {
  NetworkResult out;
  out.time_s = sweep.time_s();
  out.station = static_cast<std::uint8_t>(sweep.station);
  out.pose = why;
  return out;
}

NetworkResult NetworkTracker::process(const PlaneSweep& sweep) {
  const double now_s = sweep.time_s();
  if (running_ && now_s - accepted_s_ > kLost_s) {
    running_ = false;
    ++counters_.losses;
  }
  if (!running_) {
    if (!try_start(now_s)) return refused(sweep, pose::Refusal::kTooFewSensors);
    position_ = triangulate(used_recent(), stations_, target_, filter_.mean().pose);
    return unconfirmed(sweep);
  }
  LinearisedSweep linearised;
  const bool taken = take(sweep, linearised);
  if (strayed() || now_s - started_s_ < kConfirmed_s) return unconfirmed(sweep);
  if (!taken) {
    ++counters_.sweeps_refused;
    return refused(sweep, pose::Refusal::kPoorFit);
  }
  const double interval_s = ambiguous_ ? kCheckAmbiguous_s : kCheck_s;
  if (now_s - checked_s_ > interval_s) check_alternatives(now_s);
  return result(linearised);
}

bool NetworkTracker::fits(const LinearisedSweep& sweep) const {
  return sweep.hits() > 0 && 2 * sweep.hits() >= sweep.sensors && filter_.widest_chi2(sweep) < gate_of(sweep.hits());
}

// Predicts to the sweep and adds it where it fits. False where it was not added.
bool NetworkTracker::take(const PlaneSweep& sweep, LinearisedSweep& linearised) {
  const double now_s = std::max(time_s_, sweep.time_s());
  filter_.predict(now_s - time_s_);
  time_s_ = now_s;
  linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
  counters_.hits_left_out += sweep.hits.size() - static_cast<std::size_t>(linearised.hits());
  StationWatch& station = watch_[sweep.station];
  bool good = fits(linearised);
  if (!good && !station.excluded && ++refused_in_row_ >= kRefusedForReset) {
    filter_.reset_rates();
    ++counters_.rate_resets;
    refused_in_row_ = 0;
    linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
    good = fits(linearised);
  }
  watch(sweep.station, good, now_s);
  if (!good || station.excluded) return false;
  filter_.correct(linearised);
  saw(linearised);
  accepted_s_ = now_s;
  refused_in_row_ = 0;
  return true;
}

// A station whose sweeps contradict while another's fit was moved, or its entry in the file is wrong.
void NetworkTracker::watch(std::size_t station, bool fits, double time_s) {
  StationWatch& own = watch_[station];
  own.refused = fits ? 0 : own.refused + 1;
  own.accepted = fits ? own.accepted + 1 : 0;
  const bool other_fits = std::any_of(watch_.begin(), watch_.end(), [&](const StationWatch& other) {
    return &other != &own && !other.excluded && other.accepted >= kForExclusion && time_s - other.seen_s < kFresh_s;
  });
  if (!own.excluded && own.refused >= kForExclusion && other_fits) {
    own.excluded = true;
    ++counters_.exclusions;
  } else if (own.excluded && own.accepted >= kForReadmission) {
    own.excluded = false;
    ++counters_.readmissions;
  }
  if (fits) own.seen_s = time_s;
}

// Just after a start the filter's rates are not known: what two stations tell at once is the position then.
NetworkResult NetworkTracker::unconfirmed(const PlaneSweep& sweep) const {
  NetworkResult out = refused(sweep, pose::Refusal::kUnconfirmed);
  if (!position_) return out;
  const NetworkState& state = filter_.mean();
  out.pose = WorldFromBody{state.pose.R, *position_};
  out.covariance = state.covariance.topLeftCorner<6, 6>();
  out.covariance.topRightCorner<3, 3>().setZero();
  out.covariance.bottomLeftCorner<3, 3>().setZero();
  const double moved_m = kTriangulation_s * std::min(kFastest_m_s, state.rate.tail<3>().norm());
  out.covariance.bottomRightCorner<3, 3>() =
      station_covariance(out.time_s) + Matrix3::Identity() * (moved_m * moved_m / 3.0);
  out.flags = kFused;
  out.ambiguous = ambiguous_;
  out.second = second_;
  out.delta_chi2 = delta_chi2_;
  if (out.covariance.topLeftCorner<3, 3>().trace() > std::pow(options_.max_rotation_rad, 2)) {
    out.pose = pose::Refusal::kTooUncertain;
  }
  return out;
}

void NetworkTracker::saw(const LinearisedSweep& sweep) {
  StationWatch& station = watch_[sweep.station];
  station.plane_s[sweep.plane] = sweep.time_s;
  station.gradient[sweep.plane] = sweep.gradient;
  const double range_m = (sweep.at.pose.t - stations_[sweep.station].T_world_station->t).norm();
  station.sigma_rad[sweep.plane] =
      std::max(1e-6, stations_[sweep.station].sigmas.value_or(options_.noise.unstated).bearing_rad(range_m));
}

NetworkResult NetworkTracker::result(const LinearisedSweep& sweep) {
  const NetworkState& state = filter_.mean();
  NetworkResult out;
  out.time_s = sweep.time_s;
  out.station = static_cast<std::uint8_t>(sweep.station);
  out.observations = sweep.hits();
  out.covariance = state.covariance.topLeftCorner<6, 6>();
  const HitVector left = sweep.residual - sweep.rows.lazyProduct(state.difference(sweep.at).head<kObserved>());
  out.residual_rms_rad = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  if (sweep.hits() < sweep.sensors) out.flags |= kOutliers;
  int fresh = 0;
  for (const StationWatch& station : watch_) {
    if (station.excluded) out.flags |= kStationExcluded;
    if (!station.excluded && sweep.time_s - station.seen_s < kFresh_s) ++fresh;
  }
  if (fresh > 1) out.flags |= kFused;
  out.covariance.bottomRightCorner<3, 3>() += station_covariance(sweep.time_s);
  // Where the filter differs from what two stations tell at once, one of them is wrong by that.
  if (position_) {
    const Vector3 apart = state.pose.t - *position_;
    out.covariance.bottomRightCorner<3, 3>() += apart * apart.transpose();
  }
  const double rotation = std::sqrt(out.covariance.topLeftCorner<3, 3>().trace());
  const double position = std::sqrt(out.covariance.bottomRightCorner<3, 3>().trace());
  // One station does not tell the range of a small target.
  const bool ranged = sweep.time_s - triangulated_s_ < kCoast_s || tells_range(target_, options_.noise);
  const bool certain = ranged && rotation <= options_.max_rotation_rad && position <= options_.max_position_m;
  if (!certain) {
    out.pose = pose::Refusal::kTooUncertain;
    return out;
  }
  out.pose = state.pose;
  out.ambiguous = ambiguous_;
  out.second = second_;
  out.delta_chi2 = delta_chi2_;
  return out;
}

// What stations and planes are wrong by is the same in every sweep: it does not average out. Of the planes that saw the
// body within a tenth of a second, each off by its own sigma, a position's share of it: (J^T W J)^-1.
Matrix3 NetworkTracker::station_covariance(double time_s) const {
  Matrix3 information = Matrix3::Zero();
  for (const StationWatch& station : watch_) {
    for (std::size_t k = 0; k < kPlanes; ++k) {
      if (station.excluded || time_s - station.plane_s[k] > kFresh_s) continue;
      information +=
          station.gradient[k] * station.gradient[k].transpose() / (station.sigma_rad[k] * station.sigma_rad[k]);
    }
  }
  // Along what no plane sees now, the limits of a result hold.
  information.diagonal().array() += 1.0 / (kUnseen_m * kUnseen_m);
  return information.inverse();
}

// Where two stations see the body they tell at once where it is: a state that is elsewhere, as after a time with one
// station alone, whose range of a small target drifts, starts there.
bool NetworkTracker::strayed() {
  const NetworkState& state = filter_.mean();
  position_ = triangulate(used_recent(), stations_, target_, state.pose);
  if (!position_) return false;
  const double allowed_m = kStrayed_m + kTriangulation_s * state.rate.tail<3>().norm();
  if ((*position_ - state.pose.t).norm() < allowed_m) {
    triangulated_s_ = time_s_;
    return false;
  }
  start_at({state.pose.R, *position_}, time_s_);
  ++counters_.strays;
  return true;
}

// The recent sweeps of stations that are not excluded.
RecentSweeps NetworkTracker::used_recent() const {
  RecentSweeps out;
  for (const PlaneSweep& sweep : recent_) {
    if (!watch_[sweep.station].excluded) out.push_back(sweep);
  }
  return out;
}

// The sweeps that led to a start are added again, each at its own instant.
void NetworkTracker::start_at(const WorldFromBody& pose, double time_s) {
  filter_.start(pose);
  running_ = true;
  ++counters_.starts;
  time_s_ = recent_[0].time_s();
  for (const PlaneSweep& sweep : recent_) {
    const double now_s = std::max(time_s_, sweep.time_s());
    filter_.predict(now_s - time_s_);
    time_s_ = now_s;
    if (watch_[sweep.station].excluded) continue;
    const LinearisedSweep linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
    if (!fits(linearised)) continue;
    filter_.correct(linearised);
    saw(linearised);
  }
  accepted_s_ = checked_s_ = started_s_ = time_s;
  refused_in_row_ = 0;
}

bool NetworkTracker::try_start(double time_s) {
  const Starts starts = starts_of(recent_, stations_, target_);
  if (starts.empty()) return false;
  const Choice choice = best_start(starts);
  if (!(choice.cost < 1e299)) return false;
  WorldFromBody pose = choice.pose;
  if (const auto position = triangulate(used_recent(), stations_, target_, pose)) pose.t = *position;
  for (StationWatch& station : watch_) station.refused = station.accepted = 0;
  start_at(pose, time_s);
  ambiguous_ = choice.second_cost - choice.cost < kAmbiguousDeltaChi2;
  second_ = choice.second;
  delta_chi2_ = choice.second_cost - choice.cost;
  return true;
}

// What the recent sweeps cost from a start: -2 ln of their likelihood, twice over, so that the start itself is only a
// point to linearise at.
double NetworkTracker::cost_of(const WorldFromBody& start, WorldFromBody& refined) {
  WorldFromBody pose = start;
  double cost = 0.0;
  for (int round = 0; round < 2; ++round) {
    trial_.start(pose);
    cost = 0.0;
    double at_s = recent_[0].time_s();
    for (const PlaneSweep& sweep : recent_) {
      if (watch_[sweep.station].excluded) continue;
      const double now_s = std::max(at_s, sweep.time_s());
      trial_.predict(now_s - at_s);
      at_s = now_s;
      const LinearisedSweep linearised = linearise(sweep, stations_, target_, trial_.mean(), now_s, options_.noise);
      cost += kOutlierCost * (static_cast<double>(sweep.hits.size()) - linearised.hits());
      if (linearised.hits() == 0) continue;
      // In units of the noise: the same constant for every start.
      cost += linearised.hits() * 20.0;
      const double limit = 2.0 * kOutlierCost * linearised.hits();
      if (trial_.widest_chi2(linearised) > limit) {
        cost += limit;
        continue;
      }
      cost += trial_.correct(linearised);
    }
    pose = trial_.mean().pose;
  }
  refined = pose;
  return cost;
}

NetworkTracker::Choice NetworkTracker::best_start(const Starts& starts) {
  Choice choice;
  for (const WorldFromBody& start : starts) {
    WorldFromBody refined;
    const double cost = cost_of(start, refined);
    if (!refined.is_finite() || !std::isfinite(cost)) continue;
    if (cost < choice.cost) {
      if (choice.cost < 1e299 && !same_pose(choice.pose, refined)) {
        choice.second = choice.pose;
        choice.second_cost = choice.cost;
      }
      choice.pose = refined;
      choice.cost = cost;
    } else if (cost < choice.second_cost && !same_pose(choice.pose, refined)) {
      choice.second = refined;
      choice.second_cost = cost;
    }
  }
  return choice;
}

// A wrong minimum of a flat target may live on: stations alone, and the mirror that they tell, are asked now and then.
void NetworkTracker::check_alternatives(double time_s) {
  checked_s_ = time_s;
  Starts starts = starts_of(recent_, stations_, target_);
  if (starts.empty()) return;
  WorldFromBody own;
  const double own_cost = cost_of(filter_.mean().pose, own);
  const Choice choice = best_start(starts);
  if (!(choice.cost < 1e299)) return;
  const bool other = !same_pose(choice.pose, own);
  if (other && choice.cost < own_cost - kSwitchCost) {
    filter_.start(choice.pose);
    ++counters_.starts;
    ambiguous_ = false;
    return;
  }
  const double rival_cost = other ? choice.cost : choice.second_cost;
  ambiguous_ = rival_cost - own_cost < kAmbiguousDeltaChi2;
  second_ = other ? choice.pose : choice.second;
  delta_chi2_ = rival_cost - own_cost;
}

}  // namespace pharos::network
