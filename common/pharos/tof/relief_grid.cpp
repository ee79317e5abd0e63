// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/relief_grid.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tof {
namespace {

constexpr float kWeightUnits = 256.0F;
constexpr double kHeightUnits_m = 0.00025;
// Cells at least as wide as this many pixels hold one pixel nearly everywhere.
constexpr double kMinPixelsPerCell = 1.25;
// With more pixels across a cell every second row and column is enough.
constexpr double kManyPixelsPerCell = 2.0;
// The ring's image and its blur, beyond its circles.
constexpr double kRingMargin_px = 2.0;

struct ImageRect {
  std::int32_t left = 0, top = 0, right = -1, bottom = -1;  // included
};

// Bounds of the square's image; the whole image where a corner has none.
ImageRect image_of_square(const DepthCamera& camera, const RingModel& ring, double reach_m) {
  const PinholeCamera& lens = camera.intrinsics;
  const PlaneAxes axes = axes_of(ring.normal);
  double left = lens.width_px, right = 0.0, top = lens.height_px, bottom = 0.0;
  for (int k = -4; k <= 4; ++k) {
    for (const double s : {-1.0, 1.0}) {
      for (const Vector2& place : {Vector2(0.25 * k, s), Vector2(s, 0.25 * k)}) {
        const auto pixel = project(lens, ring.centre_m + reach_m * (place.x() * axes.first + place.y() * axes.second));
        if (!pixel) return {0, 0, lens.width_px - 1, lens.height_px - 1};
        left = std::min(left, pixel->x());
        right = std::max(right, pixel->x());
        top = std::min(top, pixel->y());
        bottom = std::max(bottom, pixel->y());
      }
    }
  }
  const auto inside = [](double value, std::int32_t size) {
    return static_cast<std::int32_t>(std::clamp(value, 0.0, size - 1.0));
  };
  return {inside(left, lens.width_px), inside(top, lens.height_px), inside(right, lens.width_px),
          inside(bottom, lens.height_px)};
}

// One row's pixels: where they meet the ring's plane and how high they are over it.
struct PixelRow {
  std::array<float, static_cast<std::size_t>(kMaxWidth_px)> along, across, height;
  RayGrid::Row<float> ray;
};

}  // namespace

void ReliefGrid::make(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& fit,
                      double reach_m) {
  const RingModel& ring = fit.model;
  const double pixel_m = ring.centre_m.z() / (camera.intrinsics.fx_px * -ring.normal.z());
  reach_m_ = reach_m;
  cell_m_ = std::max(2.0 * reach_m / kMaxGridSide, kMinPixelsPerCell * pixel_m);
  side_ = std::clamp(static_cast<int>(std::ceil(2.0 * reach_m / cell_m_)), 1, kMaxGridSide);
  std::fill_n(weight_sum_.begin(), static_cast<std::ptrdiff_t>(side_) * kMaxGridSide, 0);
  std::fill_n(moment_sum_.begin(), static_cast<std::ptrdiff_t>(side_) * kMaxGridSide, 0);
  std::fill_n(height_.begin(), static_cast<std::ptrdiff_t>(side_) * kMaxGridSide, 0.0F);
  const ImageRect rect = image_of_square(camera, ring, reach_m);
  const std::int32_t step = cell_m_ > kManyPixelsPerCell * pixel_m ? 2 : 1;
  const PlaneAxes axes = axes_of(ring.normal);
  const Eigen::Vector3f q = ring.plane().q.cast<float>(), first = axes.first.cast<float>(),
                        second = axes.second.cast<float>();
  const auto first_0 = static_cast<float>(axes.first.dot(ring.centre_m));
  const auto second_0 = static_cast<float>(axes.second.dot(ring.centre_m));
  const auto scale = static_cast<float>(camera.depth_scale_m), origin = static_cast<float>(camera.depth_origin_z_m);
  const auto per_fraction = static_cast<float>(1.0 / ring.plane().q.norm());
  const auto reach = static_cast<float>(reach_m), per_m = static_cast<float>(1.0 / cell_m_);
  const double margin_m = kRingMargin_px * pixel_m;
  const auto low = static_cast<float>(std::max(0.0, ring.radius_m[1] - margin_m));
  const auto high = static_cast<float>(ring.radius_m[0] + margin_m);
  const float low2 = low * low, high2 = high * high;
  const float per_count = kWeightUnits / static_cast<float>(std::max(1.0, fit.amplitude));
  constexpr auto kMaxHeight = static_cast<float>(kMaxRelief_m);
  const std::int32_t count = rect.right - rect.left + 1;
  PixelRow row;
  for (std::int32_t v = rect.top; v <= rect.bottom; v += step) {
    rays.row_at(rect.left, v, count, row.ray);
    const float *x = row.ray.x(), *y = row.ray.y();
    const std::uint16_t* depth = frame.depth.row(v) + rect.left;
    const std::uint16_t* light = frame.intensity.row(v) + rect.left;
    for (std::int32_t k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const float inverse_z = q.x() * x[k] + q.y() * y[k] + q.z();
      const float z_plane = 1.0F / inverse_z;
      row.along[i] = (first.x() * x[k] + first.y() * y[k] + first.z()) * z_plane - first_0;
      row.across[i] = (second.x() * x[k] + second.y() * y[k] + second.z()) * z_plane - second_0;
      const float z = static_cast<float>(depth[k]) * scale + origin;
      row.height[i] = (1.0F - z * inverse_z) * per_fraction;
    }
    for (std::int32_t k = 0; k < count; k += step) {
      if (!has_depth(depth[k]) || light[k] == 0) continue;
      const auto i = static_cast<std::size_t>(k);
      const float a = row.along[i], b = row.across[i];
      const auto column = static_cast<int>((a + reach) * per_m), line = static_cast<int>((b + reach) * per_m);
      if (!(a > -reach) || !(b > -reach) || column >= side_ || line >= side_) continue;
      const float radius2 = a * a + b * b;
      if (radius2 > low2 && radius2 < high2) continue;
      const std::size_t cell = index(column, line);
      if (row.height[i] > kMaxHeight) {
        height_[cell] = kMaxHeight;
        continue;
      }
      const float height = std::max(row.height[i], -kMaxHeight);
      // The ring's wall: there the pixel itself, not where its ray meets the plane, is as far out as the ring.
      const float nearer = 1.0F - row.height[i] / per_fraction;  // its z over the plane's
      const float wall_a = (a + first_0) * nearer - first_0, wall_b = (b + second_0) * nearer - second_0;
      const float wall2 = wall_a * wall_a + wall_b * wall_b;
      if (wall2 > low2 && wall2 < high2) continue;
      const auto weight = static_cast<std::int32_t>(std::min(kWeightUnits, static_cast<float>(light[k]) * per_count));
      weight_sum_[cell] += weight;
      moment_sum_[cell] += weight * static_cast<std::int32_t>(height * static_cast<float>(1.0 / kHeightUnits_m));
    }
  }
  finish();
}

void ReliefGrid::finish() {
  constexpr std::size_t kWidth = kMaxGridSide + 1;
  std::fill_n(weights_before_.begin(), kWidth, 0);
  std::fill_n(moments_before_.begin(), kWidth, 0);
  for (int row = 0; row < side_; ++row) {
    const std::size_t above = static_cast<std::size_t>(row) * kWidth;
    std::int64_t weights = 0, moments = 0;
    weights_before_[above + kWidth] = moments_before_[above + kWidth] = 0;
    for (int column = 0; column < side_; ++column) {
      const std::size_t cell = index(column, row), corner = above + static_cast<std::size_t>(column) + 1;
      const std::int32_t weight = weight_sum_[cell], moment = moment_sum_[cell];
      weights += weight;
      moments += moment;
      weights_before_[corner + kWidth] = weights_before_[corner] + weights;
      moments_before_[corner + kWidth] = moments_before_[corner] + moments;
      weight_[cell] = static_cast<float>(weight) * (1.0F / kWeightUnits);
      height_[cell] = weight > 0
                          ? static_cast<float>(moment) / static_cast<float>(weight) * static_cast<float>(kHeightUnits_m)
                          : height_[cell];
    }
  }
}

ReliefGrid::Sum ReliefGrid::square(int column, int row, int half) const {
  constexpr std::size_t kWidth = kMaxGridSide + 1;
  const auto left = static_cast<std::size_t>(std::clamp(column - half, 0, side_));
  const auto right = static_cast<std::size_t>(std::clamp(column + half + 1, 0, side_));
  const auto top = static_cast<std::size_t>(std::clamp(row - half, 0, side_)) * kWidth;
  const auto bottom = static_cast<std::size_t>(std::clamp(row + half + 1, 0, side_)) * kWidth;
  const auto over = [&](const std::array<std::int64_t, kCorners>& sums) {
    return static_cast<double>(sums[bottom + right] - sums[bottom + left] - sums[top + right] + sums[top + left]);
  };
  return {over(weights_before_) / static_cast<double>(kWeightUnits),
          over(moments_before_) * (kHeightUnits_m / static_cast<double>(kWeightUnits))};
}

}  // namespace pharos::tof
