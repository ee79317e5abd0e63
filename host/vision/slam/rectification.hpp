// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// Position of the rectified pixel (u, v) in a raw image: maps of one camera, row by row, px.
struct RectifyMap {
  std::vector<float> u, v;
};

/// Transforms two cameras into the rectified pair of (9).
struct Rectification {
  StereoCamera camera;
  /// p_left = R p_rectified: from the rectified left camera's frame to the raw one's; both have the same centre.
  Matrix3 R_left_rectified = Matrix3::Identity();
  /// Left and right; empty where the images are already rectified.
  std::array<RectifyMap, 2> maps;
  bool needed() const { return !maps[0].u.empty(); }
};

/// Rotates both cameras to a common frame whose x is along the baseline and whose z is the mean of theirs (Fusiello,
/// Trucco and Verri 2000). Throws InputError for a rig with too small a baseline, with images of two sizes, with the
/// right camera on the left, or with very different viewing directions.
Rectification rectify(const host::RigFile& rig, const std::string& name);

}  // namespace pharos::slam
