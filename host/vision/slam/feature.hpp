// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "host/vision/slam/descriptor.hpp"
#include "host/vision/slam/pyramid.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::slam {

/// T_camera_target, from the target's coordinates to those of the (rectified) left camera. With `--scene static` the
/// target is the scene itself.
using CameraFromTarget = Pose<frame::Camera, frame::Target>;

/// A rectified stereo pair for equation (9): rows agree, the right camera is at `baseline_m` along +x.
struct StereoCamera {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double baseline_m = 0.0;

  /// (9): d = fx b / (uL - uR).
  double depth_m(double disparity_px) const { return fx_px * baseline_m / disparity_px; }
  /// pi_s of (11), its third row with fx and cx: (u, v, u_right) px of a point in the camera's frame, z > 0.
  Vector3 project(const Vector3& p) const {
    const double u = fx_px * p.x() / p.z() + cx_px;
    return {u, fy_px * p.y() / p.z() + cy_px, u - fx_px * baseline_m / p.z()};
  }
  Vector3 back_project(const Vector2& pixel, double depth) const {
    return {(pixel.x() - cx_px) / fx_px * depth, (pixel.y() - cy_px) / fy_px * depth, depth};
  }
};

/// Repeatability of a corner: half a pixel of its level.
inline constexpr double kCornerSigma_px = 0.5;

/// One ORB feature of the left image, with its position in the right one.
struct Feature {
  Vector2 pixel = Vector2::Zero();            ///< of the rectified left image
  double right_u_px = -1.0;                   ///< its column in the right image; below 0: a mono feature
  double depth_m = -1.0;                      ///< (9), of a stereo feature
  double off_row_px = 0.0;                    ///< of a stereo feature: row in the right image minus row in the left one
  Vector2 disparity_slope = Vector2::Zero();  ///< of a stereo feature: px of disparity a px to the right and downwards
  /// 1 sigma of a coordinate, px of its level: that of a corner, or smaller where it was aligned with the patch of its
  /// point (patch.hpp).
  double sigma_px = kCornerSigma_px;
  int level = 0;           ///< of the pyramid
  double angle_rad = 0.0;  ///< of the patch, from +u towards +v
  Descriptor descriptor;

  bool stereo() const { return depth_m > 0.0; }
  bool is_corner() const { return sigma_px >= kCornerSigma_px; }  ///< not aligned with its point's patch
  /// Expected variance of a coordinate, px^2.
  double variance_px2() const { return square(sigma_px * scale_of(level)); }
  /// The same as for a corner, without regard to any alignment.
  double corner_variance_px2() const { return square(kCornerSigma_px * scale_of(level)); }

 private:
  static double square(double x) { return x * x; }
};

/// Expected error of a disparity over that of a coordinate: patches are matched to some 0.03 px of their level, while a
/// corner's position depends on the viewing direction.
inline constexpr double kDisparityFraction = 0.3;

/// A stereo feature nearer than this many baselines becomes a point at once; a farther one constrains rotation only
/// (Mur-Artal 2017).
inline constexpr double kNearBaselines = 40.0;

}  // namespace pharos::slam
