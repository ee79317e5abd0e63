// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// Where the rectified pixel (u, v) lies in a raw image: maps of one camera, row by row, px.
struct RectifyMap {
  std::vector<float> u, v;
};

/// What makes of any two cameras the rectified pair of (9).
struct Rectification {
  StereoCamera camera;
  /// p_left = R p_rectified: the left camera's own frame from that of the rectified one; they share their centre.
  Matrix3 R_left_rectified = Matrix3::Identity();
  /// Left and right; empty where the images are rectified as they come.
  std::array<RectifyMap, 2> maps;
  bool needed() const { return !maps[0].u.empty(); }
};

/// Both cameras turned to a common frame whose x runs along the baseline and whose z is the mean of theirs (Fusiello,
/// Trucco and Verri 2000). Throws InputError for a rig without a baseline worth measuring with, with images of two
/// sizes, with the right camera on the left, or with cameras that hardly look the same way.
Rectification rectify(const host::RigFile& rig, const std::string& name);

}  // namespace pharos::slam
