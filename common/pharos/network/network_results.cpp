// SPDX-License-Identifier: Apache-2.0
// What NetworkTracker reports of its state.
#include <algorithm>
#include <cmath>

#include "pharos/network/network_tracker.hpp"

namespace pharos::network {
namespace {

constexpr double kUnseen_m = 0.1;
constexpr double kFastest_m_s = 3.0;
// How long a small target is followed without two stations that agree.
constexpr double kCoast_s = 0.05;

}  // namespace

NetworkResult NetworkTracker::refused(const PlaneSweep& sweep, pose::Refusal why) const {
  NetworkResult out;
  out.time_s = sweep.time_s();
  out.station = static_cast<std::uint8_t>(sweep.station);
  out.pose = why;
  return out;
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
  // The rates are hardly known here: what they may be counts as what they are.
  const double spread_m_s = std::sqrt(state.covariance.block<3, 3>(kRateAt + 3, kRateAt + 3).trace());
  const double moved_m = kTriangulation_s * std::min(kFastest_m_s, state.rate.tail<3>().norm() + spread_m_s);
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

}  // namespace pharos::network
