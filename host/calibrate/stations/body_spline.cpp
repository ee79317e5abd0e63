// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/body_spline.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::calibrate {
namespace {

Vector3 sum_of(const std::vector<std::array<double, 3>>& control, std::size_t first,
               const std::array<double, 4>& weight) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += weight[i] * Eigen::Map<const Vector3>(control[first + i].data());
  return sum;
}

}  // namespace

SplineBasis BodySpline::basis(double time_s) const {
  const double at = (time_s - begin_s_) / step_s_;
  return basis_of(static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(segments_ - 1))),
                  time_s);
}

SplineBasis BodySpline::basis_of(std::size_t first, double time_s) const {
  SplineBasis out;
  out.first = first;
  const double u = (time_s - begin_s_) / step_s_ - static_cast<double>(first);
  const double v = 1.0 - u, u2 = u * u, u3 = u2 * u;
  out.weight = {v * v * v / 6.0, (3.0 * u3 - 6.0 * u2 + 4.0) / 6.0, (-3.0 * u3 + 3.0 * u2 + 3.0 * u + 1.0) / 6.0,
                u3 / 6.0};
  const double per = 1.0 / (step_s_ * step_s_);
  out.acceleration = {v * per, (3.0 * u - 2.0) * per, (1.0 - 3.0 * u) * per, u * per};
  return out;
}

Matrix3 BodySpline::reference(double time_s) const {
  const double at = std::clamp((time_s - begin_s_) / step_s_ + 1.0, 0.0, static_cast<double>(reference_.size() - 1));
  const auto j = std::min(static_cast<std::size_t>(at), reference_.size() - 2);
  return rotation_exp((at - static_cast<double>(j)) * reference_turn(j, j + 1)) * reference_[j];
}

network::WorldFromBody BodySpline::pose(double time_s) const {
  const SplineBasis at = basis(time_s);
  return {rotation_exp(sum_of(turn, at.first, at.weight)) * reference(time_s), sum_of(position, at.first, at.weight)};
}

Vector3 BodySpline::velocity_m_s(double time_s) const {
  constexpr double kHalf_s = 1e-3;
  return (pose(time_s + kHalf_s).t - pose(time_s - kHalf_s).t) / (2.0 * kHalf_s);
}

Vector3 BodySpline::acceleration_m_s2(double time_s) const {
  const SplineBasis at = basis(time_s);
  return sum_of(position, at.first, at.acceleration);
}

Vector3 BodySpline::reference_turn(std::size_t j, std::size_t k) const {
  return rotation_log(reference_[k] * reference_[j].transpose());
}

void BodySpline::rebase() {
  std::vector<Matrix3> moved;
  for (std::size_t j = 0; j < reference_.size(); ++j) {
    moved.push_back(orthonormalised(pose(std::clamp(control_time_s(j), begin_s_, end_s())).R));
  }
  // The ends lie beyond the spline: they keep the turn of their neighbours.
  moved.front() = rotation_exp(reference_turn(1, 0)) * moved[1];
  const std::size_t last = moved.size() - 1;
  moved[last] = rotation_exp(reference_turn(last - 1, last)) * moved[last - 1];
  reference_ = std::move(moved);
  for (auto& t : turn) t = {0.0, 0.0, 0.0};
}

}  // namespace pharos::calibrate
