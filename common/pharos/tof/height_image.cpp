// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/height_image.hpp"

namespace pharos::tof {

void make_heights(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& plane,
                  const PixelRect& rect, ImageView<std::uint16_t> heights) {
  constexpr double kMost = kMostHeight_m / kHeightUnit_m;
  for (std::int32_t v = 0; v < rect.height_px; ++v) {
    const std::uint16_t* depth = frame.depth.row(rect.v + v) + rect.u;
    std::uint16_t* out = heights.row(v);
    for (std::int32_t u = 0; u < rect.width_px; ++u) {
      if (!has_depth(depth[u])) {
        out[u] = kNoHeight;
        continue;
      }
      const double height =
          plane.height_m(rays.at(rect.u + u, rect.v + v), depth_z_m(camera, depth[u])) * (1.0 / kHeightUnit_m);
      const bool near = height > -kMost && height < kMost;
      out[u] = near ? static_cast<std::uint16_t>(kHeightZero + static_cast<std::int32_t>(height)) : kNoHeight;
    }
  }
}

}  // namespace pharos::tof
