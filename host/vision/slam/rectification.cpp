// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/rectification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/support/input_error.hpp"

namespace pharos::slam {
namespace {

// With a smaller baseline a camera pair measures no depth; a file without extrinsics has zero.
constexpr double kMinBaseline_m = 1e-4;
// Rotations and offsets that move no pixel by more than a hundredth.
constexpr double kStraight_rad = 1e-5;
constexpr double kSame_px = 0.01;
// Beyond it the rectified images would have little overlap.
constexpr double kMaxToeIn_rad = 60.0 * std::numbers::pi / 180.0;

using RigFromCamera = Pose<frame::Rig, frame::Camera>;

Matrix3 common_axes(const RigFromCamera& left, const RigFromCamera& right) {
  const Vector3 x = (right.t - left.t).normalized();
  const Vector3 ahead = left.R.col(2) + right.R.col(2);
  const Vector3 y = ahead.cross(x).normalized();
  Matrix3 axes;
  axes << x, y, x.cross(y);
  return axes;
}

bool rectified_already(const PinholeCamera& left, const PinholeCamera& right, const Matrix3& R_left,
                       const Matrix3& R_right) {
  const std::array<double, 5> none{};
  return left.distortion == none && right.distortion == none && rotation_log(R_left).norm() < kStraight_rad &&
         rotation_log(R_right).norm() < kStraight_rad && std::abs(left.fx_px - right.fx_px) < kSame_px &&
         std::abs(left.fy_px - right.fy_px) < kSame_px && std::abs(left.cx_px - right.cx_px) < kSame_px &&
         std::abs(left.cy_px - right.cy_px) < kSame_px;
}

// The principal point that centres the common field of view; f unchanged.
void centre_views(StereoCamera& camera, const std::array<const PinholeCamera*, 2>& intrinsics,
                  const std::array<Matrix3, 2>& R_camera_rectified) {
  Vector2 sum = Vector2::Zero();
  for (std::size_t side = 0; side < 2; ++side) {
    const Vector2 middle(0.5 * (intrinsics[side]->width_px - 1), 0.5 * (intrinsics[side]->height_px - 1));
    const auto ray = undistort(*intrinsics[side], middle);
    if (!ray) continue;
    const Vector3 p = R_camera_rectified[side].transpose() * Vector3(ray->x(), ray->y(), 1.0);
    sum += 0.5 * Vector2(p.x() / p.z(), p.y() / p.z());
  }
  camera.cx_px = 0.5 * (camera.width_px - 1) - camera.fx_px * sum.x();
  camera.cy_px = 0.5 * (camera.height_px - 1) - camera.fy_px * sum.y();
}

RectifyMap map_of(const PinholeCamera& intrinsics, const StereoCamera& rectified, const Matrix3& R_camera_rectified) {
  RectifyMap map;
  for (std::int32_t v = 0; v < rectified.height_px; ++v) {
    for (std::int32_t u = 0; u < rectified.width_px; ++u) {
      const Vector3 p = R_camera_rectified * rectified.back_project(Vector2(u, v), 1.0);
      // A position outside the image where the lens has no such ray: remap fills it with black.
      const auto pixel = project(intrinsics, p);
      map.u.push_back(pixel ? static_cast<float>(pixel->x()) : -1e4F);
      map.v.push_back(pixel ? static_cast<float>(pixel->y()) : -1e4F);
    }
  }
  return map;
}

void refuse(const std::string& name, const std::string& what) { throw host::InputError(name + ": " + what); }

}  // namespace

Rectification rectify(const host::RigFile& rig, const std::string& name) {
  const PinholeCamera &left = rig.left.intrinsics, &right = rig.right.intrinsics;
  if (left.width_px != right.width_px || left.height_px != right.height_px) {
    refuse(name, "the cameras have images of different sizes; a stereo pair needs one size");
  }
  const RigFromCamera T_left = rig.left.pose(), T_right = rig.right.pose();
  const double baseline = (T_right.t - T_left.t).norm();
  if (baseline < kMinBaseline_m) refuse(name, "the rig has no baseline: both cameras stand in one place");
  if ((T_left.R.transpose() * (T_right.t - T_left.t)).x() < 0.5 * baseline) {
    refuse(name, "the right camera does not stand to the right of the left one; exchange [left] and [right]");
  }
  if (std::acos(std::clamp(T_left.R.col(2).dot(T_right.R.col(2)), -1.0, 1.0)) > kMaxToeIn_rad) {
    refuse(name, "the cameras look in directions more than 60 deg apart");
  }
  const Matrix3 axes = common_axes(T_left, T_right);
  const std::array<Matrix3, 2> turns{T_left.R.transpose() * axes, T_right.R.transpose() * axes};
  Rectification result;
  result.camera = {left.width_px, left.height_px, left.fx_px, left.fy_px, left.cx_px, left.cy_px, baseline};
  if (rectified_already(left, right, turns[0], turns[1])) return result;
  result.R_left_rectified = turns[0];
  result.camera.fx_px = result.camera.fy_px = 0.25 * (left.fx_px + left.fy_px + right.fx_px + right.fy_px);
  centre_views(result.camera, {&left, &right}, turns);
  result.maps = {map_of(left, result.camera, turns[0]), map_of(right, result.camera, turns[1])};
  return result;
}

}  // namespace pharos::slam
