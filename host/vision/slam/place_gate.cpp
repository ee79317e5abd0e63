// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/place_gate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "host/vision/slam/keyframe_covariance.hpp"

namespace pharos::slam {
namespace {

constexpr double kCommonError_px = 0.1;

// Keyframes from this one to the root of the spanning tree.
std::vector<KeyframeId> ancestors(const Map& map, KeyframeId id) {
  std::vector<KeyframeId> out;
  while (id != kNone && out.size() <= map.keyframes.size()) {
    out.push_back(id);
    const auto at = map.keyframes.find(id);
    id = at == map.keyframes.end() ? kNone : at->second.parent;
  }
  return out;
}

// Rotation about `centre` and displacement of it, each isotropic, as a covariance of zeta.
Matrix6 about_centre(const Vector3& centre, double sigma_rot_rad, double sigma_move_m) {
  Matrix6 arm = Matrix6::Identity();
  arm.bottomLeftCorner<3, 3>() = skew(centre);  // v = u - omega x c
  Vector6 variance;
  variance << Vector3::Constant(sigma_rot_rad * sigma_rot_rad), Vector3::Constant(sigma_move_m * sigma_move_m);
  return arm * variance.asDiagonal() * arm.transpose();
}

}  // namespace

Matrix6 error_of_a_link(const Map& map, const Keyframe& keyframe, const StereoCamera& camera) {
  Vector3 centre = Vector3::Zero();
  double count = 0.0, sum_m2 = 0.0;
  for (const PointId id : keyframe.points) {
    const MapPoint* point = map.find_point(id);
    if (point == nullptr) continue;
    centre += point->position_m;
    sum_m2 += point->position_m.squaredNorm();
    count += 1.0;
  }
  if (count < 3.0) return Matrix6::Zero();
  centre /= count;
  const double spread_m = std::sqrt(std::max(sum_m2 / count - centre.squaredNorm(), 0.0));
  const double moved_m = kCommonError_px / camera.fx_px * (keyframe.pose * centre).norm();
  return about_centre(centre, spread_m > moved_m ? moved_m / spread_m : 1.0, moved_m);
}

Vector6 place_offset(const CameraFromTarget& asked, const CameraFromTarget& expected) {
  const Pose<frame::Target, frame::Target> between = expected.inverse() * asked;
  const Vector3 turn = rotation_log(between.R);
  const Matrix3 cross = skew(turn);
  Vector6 offset;
  offset << turn, between.t - 0.5 * turn.cross(between.t) + cross * (cross * between.t) / 12.0;
  return offset;
}

Matrix6 in_target_axes(const CameraFromTarget& pose, const Matrix6& covariance) {
  return turned(pose.R.transpose(), covariance);
}

int links_between(const Map& map, KeyframeId a, KeyframeId b) {
  const std::vector<KeyframeId> from_a = ancestors(map, a), from_b = ancestors(map, b);
  for (std::size_t k = 0; k < from_a.size(); ++k) {
    const auto common = std::find(from_b.begin(), from_b.end(), from_a[k]);
    if (common != from_b.end()) return static_cast<int>(k) + static_cast<int>(common - from_b.begin());
  }
  return static_cast<int>(from_a.size() + from_b.size());
}

Matrix6 drift_between(const Map& map, KeyframeId here, KeyframeId there, const StereoCamera& camera) {
  const double links = links_between(map, here, there);
  return map.covariance_of(here) + map.covariance_of(there) +
         links * error_of_a_link(map, map.keyframes.at(here), camera);
}

bool contradicts(const Vector6& offset, const Matrix6& covariance) {
  const Eigen::LDLT<Matrix6> factor(covariance);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return true;
  return !(offset.dot(factor.solve(offset)) <= kPlaceChi2);
}

}  // namespace pharos::slam
