// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/pixel_rays.hpp"

#include <cmath>

namespace pharos::sim {

PixelRays::PixelRays(const Lens& lens) : lens_(lens), grid_(RayGrid::pixel_centres(lens, 1)) {
  lengths_.reserve(static_cast<std::size_t>(lens.width_px) * static_cast<std::size_t>(lens.height_px));
  for (int v = 0; v < lens.height_px; ++v) {
    for (int u = 0; u < lens.width_px; ++u) lengths_.push_back(std::sqrt(1.0 + ray(u, v).squaredNorm()));
  }
}

Eigen::Matrix2d PixelRays::slope(int u, int v) const {
  Eigen::Matrix2d slope;
  slope.col(0) = 0.5 * (ray(u + 1, v) - ray(u - 1, v));
  slope.col(1) = 0.5 * (ray(u, v + 1) - ray(u, v - 1));
  return slope;
}

}  // namespace pharos::sim
