// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/height_image.hpp"

#include <algorithm>

namespace pharos::tof {

void make_heights(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& plane,
                  const PixelRect& rect, ImageView<std::uint16_t> heights) {
  // Single precision: a thousandth of a count.
  constexpr auto kMax = static_cast<float>(kMaxHeight_m / kHeightUnit_m);
  const auto scale = static_cast<float>(camera.depth_scale_m);
  const auto origin = static_cast<float>(camera.depth_origin_z_m);
  const Eigen::Vector3f q = plane.q.cast<float>();
  const auto per_fraction = static_cast<float>(1.0 / (plane.q.norm() * kHeightUnit_m));
  RayGrid::Row<float> ray;
  for (std::int32_t v = 0; v < rect.height_px; ++v) {
    const std::uint16_t* depth = frame.depth.row(rect.v + v) + rect.u;
    std::uint16_t* out = heights.row(v);
    rays.row_at(rect.u, rect.v + v, rect.width_px, ray);
    const float *x = ray.x(), *y = ray.y();
    for (std::int32_t u = 0; u < rect.width_px; ++u) {
      const float z = static_cast<float>(depth[u]) * scale + origin;
      const float height = (1.0F - z * (q.x() * x[u] + q.y() * y[u] + q.z())) * per_fraction;
      const float near = std::clamp(height, -kMax, kMax);
      const bool seen = has_depth(depth[u]) && near == height;
      out[u] = static_cast<std::uint16_t>(seen ? kHeightZero + static_cast<std::int32_t>(near) : kNoHeight);
    }
  }
}

}  // namespace pharos::tof
