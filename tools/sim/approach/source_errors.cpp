// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/source_errors.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

Vector6 sigmas(double rotation_deg, double position_mm) {
  Vector6 out;
  out.head<3>().setConstant(rotation_deg * kRadPerDeg);
  out.tail<3>().setConstant(position_mm / kMmPerM);
  return out;
}

// Root of across^2 (I - a a^T) + along^2 a a^T.
Matrix3 root_about(const Vector3& axis, double across, double along) {
  const Matrix3 projector = axis * axis.transpose();
  return across * (Matrix3::Identity() - projector) + along * projector;
}

}  // namespace

Vector3 normal3(RandomStream& random) {
  Vector3 out;
  for (int i = 0; i < 3; ++i) out[i] = random.normal();
  return out;
}

Vector6 normal6(RandomStream& random) {
  Vector6 out;
  for (int i = 0; i < 6; ++i) out[i] = random.normal();
  return out;
}

double range_factor(const RangeNoise& noise, double range_m) {
  return std::max(std::pow(range_m / noise.range_m, noise.power), noise.floor);
}

PoseNoise white_noise(const ApproachSource& source, const host::SensorFromFeature& pose, const Vector3& p_noise,
                      double ratio) {
  const RangeNoise& noise = source.noise;
  const Vector3 centre = pose * p_noise;
  const double range_m = std::max(centre.norm(), 1e-3);
  const double factor = ratio * range_factor(noise, range_m);
  const double turn_rad = source.has_turn ? noise.turn_deg * kRadPerDeg : 0.0;
  PoseNoise out;
  out.root.topLeftCorner<3, 3>() = factor * root_about(pose.R.col(2), noise.tilt_deg * kRadPerDeg, turn_rad);
  out.root.bottomRightCorner<3, 3>() =
      factor * root_about(centre / range_m, noise.lateral_mm / kMmPerM, noise.depth_mm / kMmPerM);
  // The origin of the feature turns about p_noise: dt = dp - dtheta x (R p_noise).
  out.root.bottomLeftCorner<3, 3>() = skew(pose.R * p_noise) * out.root.topLeftCorner<3, 3>();
  return out;
}

std::optional<host::SensorFromFeature> mirrored(const host::SensorFromFeature& pose, double min_angle_rad) {
  const Vector3 normal = pose.R.col(2);
  const Vector3 sight = -pose.t.normalized();
  const Vector3 other = 2.0 * normal.dot(sight) * sight - normal;
  const Vector3 axis = normal.cross(other);
  const double angle = std::atan2(axis.norm(), normal.dot(other));
  if (!(angle > min_angle_rad) || !(axis.norm() > 1e-9)) return std::nullopt;
  return host::SensorFromFeature{rotation_exp(angle * axis.normalized()) * pose.R, pose.t};
}

host::SensorFromFeature without_turn(const host::SensorFromFeature& pose) {
  const Vector3 n = pose.R.col(2);
  const double gamma = -std::asin(std::clamp(n.x(), -1.0, 1.0));
  const double theta = std::atan2(n.y(), -n.z());
  const Matrix3 half_turn = Vector3(1.0, -1.0, -1.0).asDiagonal();
  return {rotation_exp({theta, 0.0, 0.0}) * rotation_exp({0.0, gamma, 0.0}) * half_turn, pose.t};
}

SlowErrors::SlowErrors(const ApproachSource& source, RandomStream& random)
    : bias_sigma_(sigmas(source.bias.rotation_deg, source.bias.position_mm)),
      drift_sigma_(sigmas(source.drift_deg_per_sqrt_s, source.drift_mm_per_sqrt_s)),
      time_constant_s_(source.bias.time_constant_s),
      bias_(bias_sigma_.cwiseProduct(normal6(random))),
      scale_(1.0 + source.scale_sigma * random.normal()) {}

void SlowErrors::advance(double time_s, RandomStream& random) {
  const double step_s = last_s_ ? time_s - *last_s_ : 0.0;
  last_s_ = time_s;
  const double kept = std::exp(-step_s / time_constant_s_);
  bias_ = kept * bias_ + std::sqrt(std::max(1.0 - kept * kept, 0.0)) * bias_sigma_.cwiseProduct(normal6(random));
  drift_ += std::sqrt(step_s) * drift_sigma_.cwiseProduct(normal6(random));
}

}  // namespace pharos::sim
