// SPDX-License-Identifier: Apache-2.0
// What NetworkTracker reports of its state.
#include <algorithm>
#include <cmath>

#include "pharos/network/network_tracker.hpp"

namespace pharos::network {
namespace {

// Squared distance of two estimates of a position up to which they agree. The first sweeps of a station that comes back
// are explained by a wrong velocity as well: only what is expected by chance, three degrees of freedom, counts then.
constexpr double kAgreesChi2 = 9.0, kExpectedChi2 = 3.0;
// A sweep that is left so far off was taken by a state that knows hardly anything.
constexpr double kWorstResidual_rad = 0.015;
// What an attitude may be off by that leaves out hits: a flat target's mirror.
constexpr double kSuspect_rad = 0.5;
// How long a small target is followed without two stations that agree.
constexpr double kCoast_s = 0.05;

}  // namespace

NetworkResult NetworkTracker::refused(const PlaneSweep& sweep, pose::Refusal why) const {
  NetworkResult out;
  out.time_s = sweep.time_s();
  out.station = static_cast<std::uint8_t>(sweep.station);
  out.plane = static_cast<std::uint8_t>(sweep.plane);
  out.pose = why;
  return out;
}

// Just after a start, and where the filter had strayed: what two stations tell at once is the position then. The
// attitude is the filter's, off by `doubt_rad` more.
NetworkResult NetworkTracker::from_fix(const PlaneSweep& sweep, double doubt_rad) const {
  NetworkResult out = refused(sweep, pose::Refusal::kUnconfirmed);
  // Stations that contradict each other tell nothing at once.
  if (!fix_ || watch_.has_contradictions() || disputed()) return out;
  out.time_s = time_s_;  // of the latest sweep: this one may have begun before another one that is over
  const NetworkState& state = filter_.mean();
  const Vector3& position_m = fix_->position_m;
  out.pose = WorldFromBody{state.pose.R, position_m};
  out.covariance.topLeftCorner<3, 3>() = attitude_covariance(doubt_rad);
  out.covariance.bottomRightCorner<3, 3>() = station_covariance(out.time_s, position_m) + fix_->doubted_covariance();
  if (!fix_->sound)
    out.covariance.bottomRightCorner<3, 3>() += planes_.contradiction_covariance(watch_.excluded(), out.time_s);
  out.flags = kFused;
  if (watch_.any_excluded()) out.flags |= kStationExcluded;
  out.ambiguous = ambiguous_;
  out.second = second_;
  out.delta_chi2 = delta_chi2_;
  const double rotation = std::sqrt(out.covariance.topLeftCorner<3, 3>().trace());
  const double position = std::sqrt(out.covariance.bottomRightCorner<3, 3>().trace());
  if (!(rotation <= options_.max_rotation_rad && position <= options_.max_position_m)) {
    out.pose = pose::Refusal::kTooUncertain;
  }
  return out;
}

// The filter's, off by `off_rad` more, or by what is suspected.
Matrix3 NetworkTracker::attitude_covariance(double off_rad) const {
  const NetworkState& state = filter_.mean();
  const double more_rad = attitude_suspect() ? kSuspect_rad : off_rad;
  return state.covariance.topLeftCorner<3, 3>() + more_rad * more_rad * Matrix3::Identity() +
         state.pose.R * placement_covariance_ * state.pose.R.transpose();
}

double NetworkTracker::bearing_sigma(std::size_t station) const {
  const double range_m = (filter_.mean().pose.t - stations_[station].T_world_station->t).norm();
  return std::max(1e-6, stations_[station].sigmas.value_or(options_.noise.unstated).bearing_rad(range_m));
}

void NetworkTracker::saw(const LinearisedSweep& sweep) { planes_.saw(sweep, bearing_sigma(sweep.station)); }

void NetworkTracker::saw(const PositionFix& fix) {
  for (const FixPlane& plane : fix.planes) planes_.saw(plane, bearing_sigma(plane.station));
}

Matrix3 NetworkTracker::station_covariance(double time_s, const Vector3& body_m) const {
  return planes_.station_covariance(stations_, options_.noise.unstated, watch_.excluded(), time_s, body_m);
}

NetworkResult NetworkTracker::result(const LinearisedSweep& sweep) {
  const NetworkState& state = filter_.mean();
  NetworkResult out;
  out.time_s = sweep.time_s;
  out.station = static_cast<std::uint8_t>(sweep.station);
  out.plane = static_cast<std::uint8_t>(sweep.plane);
  out.observations = sweep.hits();
  out.covariance = state.covariance.topLeftCorner<6, 6>();
  out.covariance.topLeftCorner<3, 3>() = attitude_covariance(0.0);
  const HitVector left = sweep.residual - sweep.rows.lazyProduct(state.difference(sweep.at).head<kObserved>());
  out.residual_rms_rad = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  if (sweep.hits() < sweep.sensors) out.flags |= kOutliers;
  if (watch_.any_excluded()) out.flags |= kStationExcluded;
  if (watch_.fresh(sweep.time_s) > 1) out.flags |= kFused;
  out.covariance.bottomRightCorner<3, 3>() += station_covariance(sweep.time_s, state.pose.t) +
                                              planes_.contradiction_covariance(watch_.excluded(), sweep.time_s);
  // Without two stations at once the light does not tell how a small target moves along the line of sight.
  if (!fix_ && !tells_range(target_, options_.noise)) {
    const NetworkState& widest = filter_.widest();
    const Vector3 apart = widest.pose.t - state.pose.t;
    out.covariance.bottomRightCorner<3, 3>() +=
        widest.covariance.block<3, 3>(kPoseAt + 3, kPoseAt + 3) + apart * apart.transpose();
  }
  // Where the filter differs by more than the noise from what two stations tell at once, one of them is wrong by that.
  if (fix_) {
    const Vector3 apart = state.pose.t - fix_->position_m;
    const double agrees = fix_->sound ? kAgreesChi2 : kExpectedChi2;
    const double excess = 1.0 - agrees / std::max(agrees, apart_chi2(*fix_, false));
    out.covariance.bottomRightCorner<3, 3>() += excess * apart * apart.transpose();
  }
  const double rotation = std::sqrt(out.covariance.topLeftCorner<3, 3>().trace());
  const double position = std::sqrt(out.covariance.bottomRightCorner<3, 3>().trace());
  // One station does not tell the range of a small target.
  const bool ranged = fixed_.within(kCoast_s, sweep.time_s) || tells_range(target_, options_.noise);
  const bool certain = ranged && rotation <= options_.max_rotation_rad && position <= options_.max_position_m;
  if (!(out.residual_rms_rad < kWorstResidual_rad)) {
    out.pose = pose::Refusal::kPoorFit;
    return out;
  }
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

}  // namespace pharos::network
