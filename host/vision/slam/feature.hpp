// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "host/vision/slam/descriptor.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::slam {

/// T_camera_target: the target's coordinates to the (rectified) left camera's. With `--scene static` the target is the
/// scene itself.
using CameraFromTarget = Pose<frame::Camera, frame::Target>;

/// A rectified stereo pair as equation (9) wants it: rows agree, the right camera stands `baseline_m` along +x.
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

/// Scales of the image pyramid: each 1.2 times coarser (ORB's own default).
inline constexpr int kLevels = 8;
inline constexpr double kLevelScale = 1.2;
inline double scale_of(int level) { return std::pow(kLevelScale, level); }

/// One ORB feature of the left image, and where the right one has it.
struct Feature {
  Vector2 pixel = Vector2::Zero();  ///< of the rectified left image
  double right_u_px = -1.0;         ///< its column in the right image; below 0: a mono feature
  double depth_m = -1.0;            ///< (9), of a stereo feature
  double off_row_px = 0.0;          ///< of a stereo feature: how many rows lower the right image has it
  int level = 0;                    ///< of the pyramid
  double angle_rad = 0.0;           ///< of the patch, from +u towards +v
  Descriptor descriptor;

  bool stereo() const { return depth_m > 0.0; }
  /// Expected variance of a coordinate, px^2: half a pixel of its level.
  double variance_px2() const {
    const double sigma = 0.5 * scale_of(level);
    return sigma * sigma;
  }
};

/// Expected error of a disparity, in errors of a coordinate: squares of pixels are compared to some 0.03 px of their
/// level, while a corner is not the same thing from every side.
inline constexpr double kDisparityShare = 0.3;

/// A stereo feature nearer than this many baselines has a depth worth a point at once; a farther one tells rotation
/// only (Mur-Artal 2017).
inline constexpr double kNearBaselines = 40.0;

}  // namespace pharos::slam
