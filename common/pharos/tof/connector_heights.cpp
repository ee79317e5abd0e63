// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_heights.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::tof {
namespace {

// The ring's image and its blur: distance beyond its circles within which pixels are assigned to the ring.
constexpr double kRingMargin_px = 1.5;
// Pixels deeper than this many times the face around the ring are not of that face.
constexpr double kLowest = 1.5;

// Depth of the face that carries the ring below the ring's plane: the median around the ring; negative.
double typical_base(const DepthCamera& camera, const RingModel& ring, const PixelRect& rect,
                    ImageView<const std::uint16_t> heights) {
  constexpr int kDirections = 72;
  constexpr std::array<double, 3> kRadii = {1.1, 1.25, 1.4};
  const PlaneAxes axes = axes_of(ring.normal);
  std::array<double, kDirections * kRadii.size()> found{};
  std::size_t count = 0;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = kTwoPi * k / kDirections;
    const Vector3 radial = std::cos(angle) * axes.first + std::sin(angle) * axes.second;
    for (const double radius : kRadii) {
      const auto pixel = project(camera.intrinsics, ring.centre_m + radius * ring.radius_m[0] * radial);
      if (!pixel) continue;
      const auto u = static_cast<std::int32_t>(std::lround(pixel->x())) - rect.u;
      const auto v = static_cast<std::int32_t>(std::lround(pixel->y())) - rect.v;
      if (heights.contains(u, v) && heights.at(u, v) != kNoHeight) found[count++] = height_of(heights.at(u, v));
    }
  }
  if (count == 0) return -kMaxHeight_m;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(found.begin(), middle, found.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

void drop_ring_and_sides(const RayGrid& rays, const DepthCamera& camera, const RingModel& ring, const PixelRect& rect,
                         double lowest_m, ImageView<std::uint16_t> heights) {
  const std::int32_t lowest = kHeightZero + static_cast<std::int32_t>(lowest_m / kHeightUnit_m);
  const Eigen::Vector3f q = ring.plane().q.cast<float>();
  const Eigen::Vector3f centre = ring.centre_m.cast<float>();
  const double margin_m = kRingMargin_px * ring.centre_m.z() / (camera.intrinsics.fx_px * -ring.normal.z());
  const auto minimum = static_cast<float>(ring.radius_m[1] - margin_m);
  const auto maximum = static_cast<float>(ring.radius_m[0] + margin_m);
  RayGrid::Row<float> ray;
  for (std::int32_t v = 0; v < rect.height_px; ++v) {
    rays.row_at(rect.u, rect.v + v, rect.width_px, ray);
    const float *x = ray.x(), *y = ray.y();
    std::uint16_t* row = heights.row(v);
    for (std::int32_t u = 0; u < rect.width_px; ++u) {
      // Where the ray meets the plane, from the centre, times 1/z.
      const float inverse_z = q.x() * x[u] + q.y() * y[u] + q.z();
      const float du = x[u] - inverse_z * centre.x();
      const float dv = y[u] - inverse_z * centre.y();
      const float dw = 1.0F - inverse_z * centre.z();
      const float squared = du * du + dv * dv + dw * dw;
      const float unit = inverse_z * inverse_z;
      const bool on_ring = squared > minimum * minimum * unit && squared < maximum * maximum * unit;
      row[u] = row[u] < lowest || on_ring ? kNoHeight : row[u];
    }
  }
}

}  // namespace

void make_connector_heights(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                            const RingModel& ring, const PixelRect& rect, ImageView<std::uint16_t> heights) {
  make_heights(frame, camera, rays, ring.plane(), rect, heights);
  const double lowest_m = kLowest * std::min(0.0, typical_base(camera, ring, rect, heights));
  drop_ring_and_sides(rays, camera, ring, rect, lowest_m, heights);
}

}  // namespace pharos::tof
