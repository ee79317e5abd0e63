// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/tilt.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/rotation.hpp"
#include "pharos/motion/sweep_fit.hpp"

namespace pharos::motion {
namespace {

constexpr std::size_t kMinSensors = 4;
// Sigmas of the square of the tilt that a stated sigma stands for.
constexpr double kReach = 2.0;

Matrix3 reflection(const Vector3& normal) { return Matrix3::Identity() - 2.0 * normal.lazyProduct(normal.transpose()); }

}  // namespace

std::optional<Tilt> Tilt::of(const SweepFit& fit, const SensorPlane& plane, const LighthouseFromBody& pose) {
  if (fit.used.size() < kMinSensors || !plane.holds_all) return std::nullopt;
  const Matrix3 to_body = fit.pose.R.transpose();
  return Tilt(pose, to_body * (plane.centre_m - fit.pose.t), to_body * plane.normal);
}

Tilt::Tilt(const LighthouseFromBody& pose, const Vector3& body_centre_m, const Vector3& body_normal)
    : body_normal_(body_normal), body_centre_m_(body_centre_m) {
  const Vector3 normal = pose.R * body_normal;
  sight_ = (pose.R * body_centre_m + pose.t).normalized();
  across_sight_ = reflection(sight_);
  const Vector3 turn = sight_.cross(normal);
  const double sine = turn.norm();
  apart_rad_ = 2.0 * std::asin(std::min(sine, 1.0));
  axis_ = sine > 0.0 ? Vector3(turn / sine) : Vector3(Vector3::Zero());
}

double Tilt::apart_square(const Matrix3& attitude_covariance) const {
  const double variance = axis_.dot(attitude_covariance.lazyProduct(axis_));
  return variance > 0.0 ? apart_rad_ * apart_rad_ / variance : 0.0;
}

Matrix6 Tilt::second_order(const LighthouseFromBody& pose, const Matrix3& attitude_covariance) const {
  const double variance = axis_.dot(attitude_covariance.lazyProduct(axis_));
  const double tilt = 0.5 * apart_rad_, reach = tilt * (tilt - 2.0 * kReach * std::sqrt(variance));
  const double towards_zero = (tilt - std::sqrt(std::max(reach, 0.0))) / kReach;
  Vector6 turn;
  turn << axis_, (pose.R * body_centre_m_).cross(axis_);
  Matrix6 lacking = std::max(towards_zero * towards_zero - variance, 0.0) * turn.lazyProduct(turn.transpose());
  lacking.bottomRightCorner<3, 3>() +=
      range_variance(pose, attitude_covariance) * sight_.lazyProduct(sight_.transpose());
  return lacking;
}

double Tilt::range_variance(const LighthouseFromBody& pose, const Matrix3& attitude_covariance) const {
  const Matrix3 across = Matrix3::Identity() - sight_.lazyProduct(sight_.transpose());
  const Matrix3 error = across.lazyProduct(Matrix3(attitude_covariance.lazyProduct(across)));
  const double trace = error.trace();
  return 0.25 * (2.0 * error.squaredNorm() + trace * trace) * (pose.R * body_centre_m_ + pose.t).squaredNorm();
}

LighthouseFromBody Tilt::mirrored(const LighthouseFromBody& pose) const {
  LighthouseFromBody other;
  other.R = across_sight_ * pose.R * reflection(body_normal_);
  other.t = pose.t + pose.R * body_centre_m_ - other.R * body_centre_m_;
  return other;
}

Matrix6 Tilt::by_pose(const LighthouseFromBody& pose) const {
  const Matrix3 from = skew(pose.R * body_centre_m_), to = skew(mirrored(pose).R * body_centre_m_);
  Matrix6 by = Matrix6::Identity();
  by.topLeftCorner<3, 3>() = -across_sight_;  // rotations are axial
  by.bottomLeftCorner<3, 3>() = -from - to.lazyProduct(across_sight_);
  return by;
}

}  // namespace pharos::motion
