// SPDX-License-Identifier: Apache-2.0
// What NetworkTracker reports of its state.
#include <algorithm>
#include <cmath>

#include "pharos/network/network_tracker.hpp"

namespace pharos::network {
namespace {

constexpr double kUnseen_m = 0.1;
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
  if (!fix_ || contradictions_ > 0 || disputed()) return out;
  out.time_s = time_s_;  // of the latest sweep: this one may have begun before another one that is over
  const NetworkState& state = filter_.mean();
  const Vector3& position_m = fix_->position_m;
  out.pose = WorldFromBody{state.pose.R, position_m};
  out.covariance.topLeftCorner<3, 3>() = attitude_covariance(doubt_rad);
  out.covariance.bottomRightCorner<3, 3>() = station_covariance(out.time_s, position_m) + fix_->doubted_covariance();
  if (!fix_->sound) out.covariance.bottomRightCorner<3, 3>() += contradiction_covariance(out.time_s);
  out.flags = kFused;
  if (std::any_of(watch_.begin(), watch_.end(), [](const StationWatch& s) { return s.excluded; })) {
    out.flags |= kStationExcluded;
  }
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

void NetworkTracker::saw(const LinearisedSweep& sweep) {
  StationWatch& station = watch_[sweep.station];
  station.plane_s[sweep.plane] = sweep.time_s;
  if (static_cast<std::size_t>(sweep.hits()) == target_.size()) station.whole_s[sweep.plane] = sweep.time_s;
  station.gradient[sweep.plane] = sweep.gradient;
  station.contradicted_s[sweep.plane] = -1e9;
  station.sigma_rad[sweep.plane] = bearing_sigma(sweep.station);
}

void NetworkTracker::saw(const PositionFix& fix) {
  for (const FixPlane& seen : fix.planes) {
    StationWatch& station = watch_[seen.station];
    if (seen.time_s < station.plane_s[seen.plane]) continue;
    station.plane_s[seen.plane] = seen.time_s;
    station.gradient[seen.plane] = seen.gradient;
    station.sigma_rad[seen.plane] = bearing_sigma(seen.station);
  }
}

void NetworkTracker::forget_contradictions(const PositionFix& fix) {
  for (const FixPlane& seen : fix.planes) watch_[seen.station].contradicted_s[seen.plane] = -1e9;
}

// A plane whose light does not fit: the body may be where it says.
void NetworkTracker::refuse(const LinearisedSweep& sweep) {
  if (sweep.hits() == 0) return;
  const double square = std::max(1e-9, sweep.gradient.squaredNorm());
  StationWatch& station = watch_[sweep.station];
  station.contradiction_m[sweep.plane] = sweep.residual.mean() / square * sweep.gradient;
  station.contradicted_s[sweep.plane] = sweep.time_s;
}

Matrix3 NetworkTracker::contradiction_covariance(double time_s) const {
  Matrix3 sum = Matrix3::Zero();
  for (const StationWatch& station : watch_) {
    for (std::size_t k = 0; k < kPlanes; ++k) {
      if (station.excluded || time_s - station.contradicted_s[k] > kFresh_s) continue;
      sum += station.contradiction_m[k] * station.contradiction_m[k].transpose();
    }
  }
  return sum;
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
  int fresh = 0;
  for (const StationWatch& station : watch_) {
    if (station.excluded) out.flags |= kStationExcluded;
    if (!station.excluded && sweep.time_s - station.seen_s < kFresh_s) ++fresh;
  }
  if (fresh > 1) out.flags |= kFused;
  out.covariance.bottomRightCorner<3, 3>() +=
      station_covariance(sweep.time_s, state.pose.t) + contradiction_covariance(sweep.time_s);
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
  const bool ranged = sweep.time_s - fixed_s_ < kCoast_s || tells_range(target_, options_.noise);
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

// What stations and planes are wrong by is the same in every sweep: it does not average out. Of the planes that saw the
// body within a tenth of a second, each off by its own sigma, a position's part of it: (J^T W J)^-1. And what the room
// that these stations span is deformed by at that place; or, where their joint errors are known, what each of those
// moves the position by.
Matrix3 NetworkTracker::station_covariance(double time_s, const Vector3& body_m) const {
  Matrix3 information = Matrix3::Zero(), deformation = Matrix3::Zero();
  Eigen::Matrix<double, 3, static_cast<int>(kMaxErrorModes)> pulled;  // by each mode
  pulled.setZero();
  double seeing = 0.0;
  for (std::size_t s = 0; s < stations_.size(); ++s) {
    const StationWatch& station = watch_[s];
    if (!station.excluded && time_s - std::max(station.plane_s[0], station.plane_s[1]) <= kFresh_s) {
      deformation += stations_[s].sigmas.value_or(options_.noise.unstated).deformation(body_m);
      seeing += 1.0;
    }
    for (std::size_t k = 0; k < kPlanes; ++k) {
      if (station.excluded || time_s - station.plane_s[k] > kFresh_s) continue;
      const Vector3& gradient = station.gradient[k];
      const Vector3 weighted = gradient / (station.sigma_rad[k] * station.sigma_rad[k]);
      information += weighted * gradient.transpose();
      const Vector3 by_turn = (body_m - stations_[s].T_world_station->t).cross(gradient);
      const ErrorModes& modes = stations_[s].modes;
      for (std::size_t m = 0; m < modes.size(); ++m) {
        pulled.col(static_cast<Eigen::Index>(m)) +=
            weighted * (by_turn.dot(modes[m].head<3>()) + gradient.dot(modes[m].tail<3>()));
      }
    }
  }
  // Along what no plane sees now, the limits of a result hold.
  information.diagonal().array() += 1.0 / (kUnseen_m * kUnseen_m);
  const Matrix3 covariance = information.inverse();
  pulled = covariance.lazyProduct(pulled).eval();
  return covariance + deformation / std::max(1.0, seeing) + pulled.lazyProduct(pulled.transpose());
}

}  // namespace pharos::network
