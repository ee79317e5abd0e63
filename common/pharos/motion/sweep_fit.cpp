// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/sweep_fit.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/plane_fit.hpp"

namespace pharos::motion {
namespace {

// Nearer to the station than this no sensor is lit.
constexpr double kNearest_m = 1e-3;

// Additional own noise of a narrow pulse: 5 arcsec at 52 ticks, as one over the width's square, maximum 25 arcsec
// (stationary sensors in recordings: README). From 150 ticks on it is zero.
constexpr double kNarrow_rad = 5.0 * kRadPerArcsec, kNarrow_ticks = 52.0, kMaxNarrow_rad = 25.0 * kRadPerArcsec;

// No sensor is this far from its place: seven times what those of a target built from its drawing are.
constexpr double kForeign_m = 3e-3;

// Sweeps that an attitude error lasts, so that its second order does not average out in them: 2.5 s of one station.
constexpr double kSameErrorSweeps = 300.0;
// More than any shift (rad), stretch or shear (rad a metre) of a pattern that a prediction leaves.
constexpr double kAnyShift_rad = 0.01, kAnyStretch_rad_m = 0.1;
// Sensors with more relief show a tilt itself.
constexpr double kCoplanar_m = 0.5e-3;

bool is_foreign(const HitFit& hit, double departure_rad) {
  return std::abs(departure_rad) * hit.point_m.norm() > kForeign_m;
}

using Candidates = StaticVector<HitFit, kMaxHitsPerSweep>;

// A width of zero means unknown.
double narrow_variance(std::uint16_t width_ticks) {
  if (width_ticks == 0) return 0.0;
  const double narrowness = kNarrow_ticks / width_ticks;
  const double added_rad = std::min(kNarrow_rad * narrowness * narrowness, kMaxNarrow_rad);
  return added_rad * added_rad;
}

double quadratic(const Vector6& h, const Matrix6& m) { return h.dot(m.lazyProduct(h)); }

// Prediction of points at instants near the estimate's own.
class Linearisation {
 public:
  Linearisation(Axis axis, const StationView& view, const StateEstimate& state_estimate, std::int64_t time_ticks,
                double own_variance)
      : axis_(axis),
        view_(view),
        state_estimate_(state_estimate),
        time_ticks_(time_ticks),
        own_variance_(own_variance) {}

  // False where the point would be behind the station.
  bool hit(const lighthouse::Bearing& bearing, const Vector3& body_m, HitFit& fit) const {
    const double dt_s = ticks_to_seconds(bearing.time_ticks - time_ticks_);
    const Vector3 q = state_estimate_.pose.R * body_m;
    const Vector3 p =
        q + state_estimate_.pose.t + dt_s * (state_estimate_.rate.tail<3>() + state_estimate_.rate.head<3>().cross(q));
    const double along = p[index_of(axis_)], ahead = p.z();
    if (!(ahead > kNearest_m)) return false;
    const double inverse_square = 1.0 / (along * along + ahead * ahead);
    Vector3 gradient = Vector3::Zero();
    gradient[index_of(axis_)] = -ahead * inverse_square;
    gradient.z() = along * inverse_square;
    fit.jacobian << q.cross(gradient), gradient;
    fit.point_m = p;
    if (view_.calibration != nullptr) {
      const lighthouse::ThetaPair ideal = lighthouse::ideal_thetas(p);
      fit.residual_rad = bearing.theta_rad - raw_theta(*view_.calibration, view_.form, axis_, ideal);
      fit.ideal_rad = ideal[axis_] + fit.residual_rad;
    } else {
      const double ideal = kPi / 2 - std::atan2(along, ahead);
      fit.residual_rad = bearing.theta_rad - ideal;
      fit.ideal_rad = ideal + fit.residual_rad;
    }
    // The uncertainty of the rates moves the point between this hit and the estimate's instant.
    fit.variance = own_variance_ + narrow_variance(bearing.width_ticks) +
                   dt_s * dt_s *
                       (inverse_square * state_estimate_.velocity_variance +
                        fit.jacobian.head<3>().squaredNorm() * state_estimate_.rotation_rate_variance);
    return true;
  }

 private:
  Axis axis_;
  const StationView& view_;
  const StateEstimate& state_estimate_;
  std::int64_t time_ticks_;
  double own_variance_;
};

double median_residual(const HitFits& hits) {
  StaticVector<double, kMaxSensors> values;
  for (const HitFit& hit : hits) values.push_back(hit.residual_rad);
  double* middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// For each sensor the candidate whose residual is nearest to `centre`.
HitFits nearest_to(double centre, const Candidates& candidates, const lighthouse::SweepBearings& bearings) {
  std::array<std::int8_t, kMaxSensors> place;
  place.fill(-1);
  HitFits chosen;
  for (const HitFit& candidate : candidates) {
    std::int8_t& at = place[bearings[candidate.bearing].sensor];
    if (at < 0) {
      at = static_cast<std::int8_t>(chosen.size());
      chosen.push_back(candidate);
      continue;
    }
    HitFit& alternative = chosen[static_cast<std::size_t>(at)];
    if (std::abs(candidate.residual_rad - centre) < std::abs(alternative.residual_rad - centre))
      alternative = candidate;
  }
  return chosen;
}

// Leaves out what departs from the common shift; everything where the shift itself is implausible. Returns how many of
// them are foreign.
int gate(HitFits& hits, const Vector6& mean, double centre, const Matrix6& covariance, double common_variance) {
  double own = 0.0;
  for (const HitFit& hit : hits) own = std::max(own, hit.variance);
  constexpr double kSquare = kHitGate * kHitGate;
  if (centre * centre > kSquare * (quadratic(mean, covariance) + own + common_variance)) {
    const int all = static_cast<int>(hits.size());
    hits.clear();
    return all;
  }
  int foreign = 0;
  for (std::size_t i = hits.size(); i-- > 0;) {
    const double departure = hits[i].residual_rad - centre;
    // The median itself has up to one hit's noise.
    const double spread = quadratic(hits[i].jacobian - mean, covariance) + 2.0 * hits[i].variance;
    if (departure * departure <= kSquare * spread) continue;
    foreign += is_foreign(hits[i], departure) ? 1 : 0;
    hits.erase_unordered(i);
  }
  return foreign;
}

SweepInformation summed(const HitFits& hits, double common_variance) {
  InformationSums sums;
  for (const HitFit& hit : hits) sums.add(hit.jacobian, hit.residual_rad, 1.0 / hit.variance);
  return sums.close(common_variance);
}

// The hit that fits the others' pose worst; its residual in standard deviations.
std::size_t worst_of(const HitFits& hits, const SweepInformation& information, const Matrix6& covariance,
                     double& deviations) {
  const Innovation innovation = innovation_of(information, covariance, Vector6::Zero());
  const Vector6 shift = pose_shift(information, innovation);
  double weights = 0.0, mean = 0.0;
  for (const HitFit& hit : hits) {
    weights += 1.0 / hit.variance;
    mean += (hit.residual_rad - hit.jacobian.dot(shift)) / hit.variance;
  }
  mean /= weights;
  std::size_t worst = 0;
  deviations = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double left = hits[i].residual_rad - hits[i].jacobian.dot(shift) - mean;
    const double size = std::abs(left) / std::sqrt(hits[i].variance);
    if (size > deviations) {
      deviations = size;
      worst = i;
    }
  }
  return worst;
}

// A rotation d moves a point at q from the centre by d x q + d x (d x q) / 2; the centre's own shift is the
// translation's. The second part changes a bearing by q . w, w = (d (g . d) - g (d . d)) / 2 with the gradient g of the
// bearing, one for all hits: each component is half a square d . A d. This is the covariance of w for d ~ N(0, P):
// tr(A_k P A_l P) / 2.
Matrix3 second_order_covariance(const Vector3& gradient, const Matrix3& attitude) {
  std::array<Matrix3, 3> by_attitude;
  for (int k = 0; k < 3; ++k) {
    Matrix3 square = Matrix3::Zero();
    square.row(k) += 0.5 * gradient.transpose();
    square.col(k) += 0.5 * gradient;
    square.diagonal().array() -= gradient[k];
    by_attitude[static_cast<std::size_t>(k)] = square.lazyProduct(attitude);
  }
  Matrix3 covariance;
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      const Matrix3 &row = by_attitude[static_cast<std::size_t>(k)], &column = by_attitude[static_cast<std::size_t>(l)];
      covariance(k, l) = 0.5 * row.lazyProduct(column).trace();
    }
  }
  return covariance;
}

bool credible(const SweepInformation& information) {
  return information.residual_chi2 <= pose::chi2_threshold(information.hits - information.rank);
}

}  // namespace

[[gnu::flatten]] SweepFit fit_sweep(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                                    const StateEstimate& state_estimate, std::int64_t time_ticks,
                                    const SweepNoise& noise) {
  SweepFit fit;
  fit.pose = state_estimate.pose;
  const double common_variance = noise.common_rad * noise.common_rad;
  const Linearisation linearisation(axis, view, state_estimate, time_ticks, noise.own_rad * noise.own_rad);
  Candidates candidates;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const SensorPlacement* sensor = find_sensor(*view.target, bearings[i].sensor);
    HitFit hit;
    hit.bearing = static_cast<std::uint8_t>(i);
    if (sensor != nullptr && linearisation.hit(bearings[i], sensor->position_m, hit)) candidates.push_back(hit);
  }
  fit.candidates = static_cast<int>(candidates.size());
  if (candidates.empty()) return fit;

  fit.used = nearest_to(0.0, candidates, bearings);
  fit.sensors = static_cast<int>(fit.used.size());
  const double centre = median_residual(fit.used);
  if (candidates.size() > fit.used.size()) fit.used = nearest_to(centre, candidates, bearings);
  fit.shift_rad = centre;
  for (const HitFit& hit : fit.used) fit.shift_jacobian += hit.jacobian;
  fit.shift_jacobian /= static_cast<double>(fit.used.size());
  fit.foreign = gate(fit.used, fit.shift_jacobian, centre, state_estimate.gate_covariance, common_variance);
  fit.information = summed(fit.used, common_variance);
  while (!credible(fit.information)) {
    double deviations = 0.0;
    const std::size_t worst = worst_of(fit.used, fit.information, state_estimate.gate_covariance, deviations);
    if (deviations < kHitGate) break;
    fit.foreign += is_foreign(fit.used[worst], deviations * std::sqrt(fit.used[worst].variance)) ? 1 : 0;
    fit.used.erase_unordered(worst);
    fit.information = summed(fit.used, common_variance);
  }
  fit.log_density = kStrayLogDensity * (fit.sensors - static_cast<int>(fit.used.size()));
  for (const HitFit& hit : fit.used) fit.log_density += std::log(hit.variance);
  return fit;
}

SensorPlane SensorPlane::of(const HitFits& hits) {
  SensorPlane plane;
  for (const HitFit& hit : hits) plane.centre_m += hit.point_m;
  plane.centre_m /= static_cast<double>(hits.size());
  pose::PlaneFit fit(plane.centre_m);
  for (const HitFit& hit : hits) fit.add(hit.point_m);
  plane.normal = fit.normal();
  plane.holds_all = fit.thickness_m(plane.normal) <= kCoplanar_m;
  return plane;
}

void count_second_order(SweepFit& fit, const SensorPlane& plane, const Matrix3& attitude_covariance,
                        const SweepNoise& noise) {
  Vector3 gradient = Vector3::Zero();
  for (const HitFit& hit : fit.used) gradient += hit.jacobian.tail<3>();
  gradient /= static_cast<double>(fit.used.size());
  const Matrix3 attitude =
      attitude_covariance * std::min(1.0, kTiltAlone_rad * kTiltAlone_rad / attitude_covariance.trace());
  SharedSums sums(kSameErrorSweeps * second_order_covariance(gradient, attitude), noise.common_rad * noise.common_rad);
  for (const HitFit& hit : fit.used) {
    sums.add(hit.jacobian, hit.residual_rad, 1.0 / hit.variance, hit.point_m - plane.centre_m);
  }
  fit.information = sums.close();
  fit.log_density += sums.log_determinant();
}

SweepInformation perspective_of(const SweepFit& fit, const SensorPlane& plane, double systematic_rad) {
  SharedSums sums(kAnyStretch_rad_m * kAnyStretch_rad_m * Matrix3::Identity(), kAnyShift_rad * kAnyShift_rad);
  for (const HitFit& hit : fit.used) {
    const double variance = hit.variance + kSameErrorSweeps * systematic_rad * systematic_rad;
    sums.add(hit.jacobian, hit.residual_rad, 1.0 / variance, hit.point_m - plane.centre_m);
  }
  return sums.close();
}

}  // namespace pharos::motion
