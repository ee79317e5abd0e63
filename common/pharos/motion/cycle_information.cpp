// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/cycle_information.hpp"

#include "pharos/geometry/packed_symmetric.hpp"
#include "pharos/motion/unrolled.hpp"
#include "pharos/pose/covariance.hpp"

namespace pharos::motion {
namespace {

// A station of two pauses for a rotor revolution between its cycles.
constexpr std::int64_t kOldest_ticks = 3 * 833'333 / 2;

// sum += h h^T, its lower triangle.
void add_square(Matrix6& sum, const Vector6& h) {
  for_each_number<6>([&](auto number) {
    constexpr int j = number, rows = 6 - even(j);
    sum.col(j).tail<rows>() += h.tail<rows>() * h[j];
  });
}

PackedSymmetric<6> packed_sum(const Matrix6& a, const Matrix6& b) {
  PackedSymmetric<6> packed;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) packed(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = a(i, j) + b(i, j);
  }
  return packed;
}

}  // namespace

[[gnu::flatten]] CycleInformation::ResidualChi2 CycleInformation::set(Axis axis, const HitFits& hits,
                                                                      double own_variance, std::int64_t time_ticks,
                                                                      bool with_rotors) {
  const auto a = static_cast<std::size_t>(index_of(axis));
  Sweep& now = sweep_[a];
  const Sweep& before = sweep_[1 - a];
  now = {};
  now.time_ticks = time_ticks;
  now.hits = static_cast<int>(hits.size());
  double weights = 0.0, residual = 0.0;
  Vector6 weighted = Vector6::Zero();
  for (const HitFit& hit : hits) {
    const double weight = own_variance / hit.variance;
    const Vector6 h = weight * hit.jacobian;
    add_square(now.square, hit.jacobian);
    now.sum += hit.jacobian;
    if (with_rotors) now.by_rotor += hit.jacobian.lazyProduct(rotor_terms(axis, hit.point_m).transpose());
    now.centred += h.lazyProduct(hit.jacobian.transpose());
    now.by_residual += h * hit.residual_rad;
    now.residual_square += weight * hit.residual_rad * hit.residual_rad;
    weights += weight;
    residual += weight * hit.residual_rad;
    weighted += h;
  }
  now.square.triangularView<Eigen::StrictlyUpper>() = now.square.transpose();
  now.centred -= (1.0 / weights) * weighted.lazyProduct(weighted.transpose());
  now.by_residual -= (residual / weights) * weighted;
  now.residual_square -= residual * residual / weights;

  known_ = before.time_ticks != INT64_MIN && time_ticks - before.time_ticks <= kOldest_ticks;
  if (!known_) return {};
  const Factorisation<6> normal(packed_sum(now.square, before.square));
  known_ = normal.smallest_ratio() > pose::kDegeneratePivotRatio;
  if (!known_) return {};
  for (int j = 0; j < 6; ++j) {
    std::array<double, 6> unit{};
    unit[static_cast<std::size_t>(j)] = 1.0;
    const std::array<double, 6> column = normal.solve(unit);
    for (int i = 0; i < 6; ++i) unit_(i, j) = column[static_cast<std::size_t>(i)];
  }
  rotors_known_ = with_rotors;
  for (std::size_t k = 0; with_rotors && k < kAxes; ++k) pose_by_rotor_[k] = unit_.lazyProduct(sweep_[k].by_rotor);

  constexpr int kUnknowns = 6 + kAxes;  // a pose, and a shift of each sweep
  const int freedom = now.hits + before.hits - kUnknowns;
  const Factorisation<6> centred(packed_sum(now.centred, before.centred));
  if (freedom <= 0 || centred.smallest_ratio() < pose::kDegeneratePivotRatio) return {};
  std::array<double, 6> right;
  for (int i = 0; i < 6; ++i) right[static_cast<std::size_t>(i)] = now.by_residual[i] + before.by_residual[i];
  const std::array<double, 6> best = centred.solve(right);
  double explained = 0.0;
  for (std::size_t i = 0; i < 6; ++i) explained += best[i] * right[i];
  const double square = now.residual_square + before.residual_square - explained;
  return {square > 0.0 ? square / own_variance : 0.0, static_cast<double>(freedom)};
}

void CycleInformation::shifted(Axis axis, const Vector6& shift) {
  Sweep& sweep = sweep_[static_cast<std::size_t>(index_of(axis))];
  const Vector6 moved = sweep.centred * shift;
  sweep.residual_square += shift.dot(moved) - 2.0 * shift.dot(sweep.by_residual);
  sweep.by_residual -= moved;
}

// What the errors make of the right side of the normal equations, times their inverse.
inline Matrix6 CycleInformation::unit_errors(double own, double common) const {
  Matrix6 middle = own * (sweep_[0].square + sweep_[1].square);
  for (const Sweep& sweep : sweep_) middle += common * sweep.sum.lazyProduct(sweep.sum.transpose());
  return middle.lazyProduct(unit_);
}

[[gnu::flatten]] Matrix6 CycleInformation::covariance_of(double own, double common) const {
  return unit_.lazyProduct(unit_errors(own, common));
}

[[gnu::flatten]] Vector6 CycleInformation::variances_of(double own, double common) const {
  const Matrix6 errors = unit_errors(own, common);
  Vector6 variances = unit_.col(0).cwiseProduct(errors.row(0).transpose());
  for (int k = 1; k < 6; ++k) variances += unit_.col(k).cwiseProduct(errors.row(k).transpose());
  return variances;
}

std::optional<Matrix6> CycleInformation::covariance_of(const RotorSpread& spread) const {
  if (!rotors_known_) return std::nullopt;
  const RotorTerms variances = rotor_variances(spread);
  Matrix6 covariance = Matrix6::Zero();
  for (const auto& by_rotor : pose_by_rotor_) {
    for (int k = 0; k < kRotorTerms; ++k) {
      covariance += variances[k] * by_rotor.col(k).lazyProduct(by_rotor.col(k).transpose());
    }
  }
  return covariance;
}

}  // namespace pharos::motion
