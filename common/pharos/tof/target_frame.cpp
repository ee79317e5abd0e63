// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/target_frame.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::tof {
namespace {

using Matrix65 = Eigen::Matrix<double, 6, 5>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix68 = Eigen::Matrix<double, 6, 8>;

Matrix3 about_x(double angle) {
  Matrix3 m;
  m << 1, 0, 0, 0, std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle);
  return m;
}
Matrix3 about_y(double angle) {
  Matrix3 m;
  m << std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle);
  return m;
}
Matrix3 about_z(double angle) {
  Matrix3 m;
  m << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  return m;
}

// Z' along the normal, X' as near to `towards` as possible.
Matrix3 frame_of(const Vector3& normal, const Vector3& towards) {
  Matrix3 R;
  R.col(2) = normal;
  R.col(1) = normal.cross(towards).normalized();
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

// Intersection of the ray of the connector's face with the plane `height` over the ring's.
Vector3 face_point(const Vector3& normal, const Vector3& centre, const Vector2& ray, double height) {
  const Vector3 direction(ray.x(), ray.y(), 1.0);
  return ((normal.dot(centre) + height) / normal.dot(direction)) * direction;
}

// The five unknowns of the ring (two turns, centre), the connector's ray and its height.
struct Measured {
  Vector3 normal;
  Vector3 centre;
  Vector2 ray;
  double height;

  Measured moved(const PlaneAxes& axes, const Vector8& by) const {
    return {rotation_exp(by[0] * axes.first + by[1] * axes.second) * normal, centre + by.segment<3>(2),
            ray + by.segment<2>(5), height + by[7]};
  }
  Matrix3 attitude() const { return frame_of(normal, face_point(normal, centre, ray, height) - centre); }
};

// Steps of the central differences: small against every curvature, large against rounding.
constexpr double kStep = 1e-6;

}  // namespace

TargetAngles angles_of(const Matrix3& R_camera_target) {
  const Matrix3 R = Vector3(1.0, -1.0, -1.0).asDiagonal() * R_camera_target;
  return {std::atan2(-R(1, 2), R(2, 2)), std::asin(std::clamp(R(0, 2), -1.0, 1.0)), std::atan2(-R(0, 1), R(0, 0))};
}

Matrix3 attitude_of(const TargetAngles& angles) {
  return Vector3(1.0, -1.0, -1.0).asDiagonal() *
         (about_x(angles.alpha_rad) * about_y(angles.beta_rad) * about_z(angles.gamma_rad));
}

TargetPose target_pose(const RingFit& ring, const ConnectorFace& face) {
  const RingModel& model = ring.model;
  const PlaneAxes axes = axes_of(model.normal);
  const Vector2& plan = face.rectangle.centre_m;
  const Vector3 point = model.centre_m + plan.x() * axes.first + plan.y() * axes.second + face.height_m * model.normal;
  const Measured measured{model.normal, model.centre_m, point.head<2>() / point.z(), face.height_m};
  TargetPose result;
  result.pose = {measured.attitude(), model.centre_m};
  Matrix68 jacobian = Matrix68::Zero();
  for (int k = 0; k < 8; ++k) {
    const Vector8 step = kStep * Vector8::Unit(k);
    const Matrix3 turned = measured.moved(axes, step).attitude() * measured.moved(axes, -step).attitude().transpose();
    jacobian.col(k).head<3>() = rotation_log(turned) / (2.0 * kStep);
    if (k >= 2 && k < 5) jacobian(k + 1, k) = 1.0;
  }
  // The face's position was measured in the ring's plane; as a ray it does not move with the ring.
  Eigen::Matrix<double, 2, 2> ray_by_plan;
  const std::array<Vector3, 2> directions = {axes.first, axes.second};
  for (int k = 0; k < 2; ++k) {
    const Vector3& d = directions[static_cast<std::size_t>(k)];
    ray_by_plan.col(k) = (d.head<2>() - point.head<2>() / point.z() * d.z()) / point.z();
  }
  Matrix8 covariance = Matrix8::Zero();
  covariance.topLeftCorner<5, 5>() = ring.covariance.topLeftCorner<5, 5>();
  covariance.block<2, 2>(5, 5) = ray_by_plan * face.covariance * ray_by_plan.transpose();
  covariance(7, 7) = face.sigma_height_m * face.sigma_height_m;
  // Lazily: for eight rows Eigen's other product takes blocks from the heap.
  const Matrix68 half = jacobian.lazyProduct(covariance);
  result.covariance = half.lazyProduct(jacobian.transpose());
  return result;
}

TargetPose target_pose(const RingFit& ring, const ConnectorFace& face, double direction_rad,
                       double direction_sigma_rad) {
  TargetPose result = target_pose(ring, face);
  // About Z': the error, in the camera frame, is that of the direction to the connector.
  result.pose.R = result.pose.R * about_z(-direction_rad);
  const Vector3& normal = ring.model.normal;
  result.covariance.topLeftCorner<3, 3>() += direction_sigma_rad * direction_sigma_rad * normal * normal.transpose();
  return result;
}

TargetPose target_pose_without_turn(const RingFit& ring) {
  const Vector3& normal = ring.model.normal;
  const PlaneAxes axes = axes_of(normal);
  TargetPose result;
  result.pose = {frame_of(normal, axes.first), ring.model.centre_m};
  Matrix65 jacobian = Matrix65::Zero();
  jacobian.col(0).head<3>() = axes.first;
  jacobian.col(1).head<3>() = axes.second;
  jacobian.block<3, 3>(3, 2) = Matrix3::Identity();
  result.covariance = jacobian * ring.covariance.topLeftCorner<5, 5>() * jacobian.transpose();
  result.covariance.topLeftCorner<3, 3>() += (kPi * kPi / 3.0) * normal * normal.transpose();
  return result;
}

}  // namespace pharos::tof
