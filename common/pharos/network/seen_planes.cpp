// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/seen_planes.hpp"

#include <algorithm>

namespace pharos::network {
namespace {

constexpr double kUnseen_m = 0.1;

}  // namespace

void SeenPlanes::saw(const LinearisedSweep& sweep, double sigma_rad) {
  Seen& plane = seen_[sweep.station][sweep.plane];
  plane.last.set(sweep.time_s);
  plane.gradient = sweep.gradient;
  plane.sigma_rad = sigma_rad;
  plane.contradicted.forget();
}

void SeenPlanes::saw(const FixPlane& seen, double sigma_rad) {
  Seen& plane = seen_[seen.station][seen.plane];
  if (plane.last.later_than(seen.time_s)) return;
  plane.last.set(seen.time_s);
  plane.gradient = seen.gradient;
  plane.sigma_rad = sigma_rad;
}

void SeenPlanes::refuse(const LinearisedSweep& sweep) {
  if (sweep.hits() == 0) return;
  const double square = std::max(1e-9, sweep.gradient.squaredNorm());
  Seen& plane = seen_[sweep.station][sweep.plane];
  plane.contradiction_m = sweep.residual.mean() / square * sweep.gradient;
  plane.contradicted.set(sweep.time_s);
}

void SeenPlanes::forget_contradictions(const PositionFix& fix) {
  for (const FixPlane& plane : fix.planes) seen_[plane.station][plane.plane].contradicted.forget();
}

void SeenPlanes::forget_contradictions() {
  for (Planes& planes : seen_) {
    for (Seen& plane : planes) plane.contradicted.forget();
  }
}

Matrix3 SeenPlanes::contradiction_covariance(const StationMask& excluded, double time_s) const {
  Matrix3 sum = Matrix3::Zero();
  for (std::size_t s = 0; s < seen_.size(); ++s) {
    for (const Seen& plane : seen_[s]) {
      if (excluded[s] || !plane.contradicted.within(kFresh_s, time_s)) continue;
      sum += plane.contradiction_m * plane.contradiction_m.transpose();
    }
  }
  return sum;
}

Matrix3 SeenPlanes::station_covariance(const Stations& stations, const StationSigmas& unstated,
                                       const StationMask& excluded, double time_s, const Vector3& body_m) const {
  Matrix3 information = Matrix3::Zero(), deformation = Matrix3::Zero();
  Eigen::Matrix<double, 3, static_cast<int>(kMaxErrorModes)> pulled;  // by each mode
  pulled.setZero();
  double seeing = 0.0;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    if (excluded[s]) continue;
    const Station& station = stations[s];
    if (seen_[s][0].last.within(kFresh_s, time_s) || seen_[s][1].last.within(kFresh_s, time_s)) {
      deformation += station.sigmas.value_or(unstated).deformation(body_m);
      seeing += 1.0;
    }
    for (const Seen& plane : seen_[s]) {
      if (!plane.last.within(kFresh_s, time_s)) continue;
      const Vector3 weighted = plane.gradient / (plane.sigma_rad * plane.sigma_rad);
      information += weighted * plane.gradient.transpose();
      const Vector3 by_turn = (body_m - station.T_world_station->t).cross(plane.gradient);
      for (std::size_t m = 0; m < station.modes.size(); ++m) {
        pulled.col(static_cast<Eigen::Index>(m)) +=
            weighted * (by_turn.dot(station.modes[m].head<3>()) + plane.gradient.dot(station.modes[m].tail<3>()));
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
