// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/surroundings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/tof/constants.hpp"

namespace pharos::tof {
namespace {

// Maximum number of pixels sampled.
constexpr std::size_t kMaxSamples = 512;
// A face enlarged by noise is at least a third of its region: this quantile lies on the face.
constexpr double kFaceQuantile = 0.85;

// Counts of the height image.
struct HeightSamples {
  std::array<std::uint16_t, kMaxSamples> height;  // `count` of them
  std::size_t count = 0;

  bool full() const { return count == kMaxSamples; }
  void add(std::uint16_t value) {
    if (count < kMaxSamples) height[count++] = value;
  }
  std::uint16_t quantile(double fraction) {
    const auto place = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(count - 1));
    std::nth_element(height.begin(), height.begin() + place, height.begin() + static_cast<std::ptrdiff_t>(count));
    return height[static_cast<std::size_t>(place)];
  }
};

// Of the region's pixels, row by row between its outline; holes are few.
HeightSamples inside_of(ImageView<const std::uint16_t> heights, const Region& region) {
  HeightSamples samples;
  const std::int32_t stride = 1 + region.rows() * region.columns() / static_cast<std::int32_t>(kMaxSamples);
  std::int32_t passed = stride - 1;
  for (std::int32_t v = region.top; v <= region.bottom; ++v) {
    const Region::Extent& row = region.row[static_cast<std::size_t>(v - region.top)];
    for (std::int32_t u = row.first; u <= row.last; ++u) {
      if (heights.at(u, v) == kNoHeight || ++passed < stride) continue;
      samples.add(heights.at(u, v));
      passed = 0;
    }
  }
  return samples;
}

std::int32_t reach_around(const Region& region) { return std::max<std::int32_t>({6, region.rows(), region.columns()}); }
std::int32_t stride_around(const Region& region) { return 1 + reach_around(region) / 16; }

HeightSamples around(ImageView<const std::uint16_t> heights, const Region& region) {
  const std::int32_t reach = reach_around(region), stride = stride_around(region);
  HeightSamples samples;
  for (std::int32_t v = region.top - reach; v <= region.bottom + reach && !samples.full(); v += stride) {
    if (v < 0 || v >= heights.height_px) continue;
    const bool own_row = v >= region.top - 1 && v <= region.bottom + 1;
    const std::uint16_t* row = heights.row(v);
    for (std::int32_t u = region.left - reach; u <= region.right + reach; u += stride) {
      const bool own = own_row && u >= region.left - 1 && u <= region.right + 1;
      if (own || u < 0 || u >= heights.width_px || row[u] == kNoHeight) continue;
      samples.add(row[u]);
    }
  }
  return samples;
}

}  // namespace

Surroundings surroundings_of(ImageView<const std::uint16_t> heights, const Region& region) {
  Surroundings found;
  found.stride_px = stride_around(region);
  HeightSamples samples = around(heights, region);
  found.samples = samples.count;
  if (samples.count < kMinSurroundings) return found;
  const std::uint16_t base = samples.quantile(0.5);
  found.base_m = height_of(base);
  for (std::size_t i = 0; i < samples.count; ++i) {
    samples.height[i] = static_cast<std::uint16_t>(std::abs(samples.height[i] - base));
  }
  found.sigma_m = kMedianToSigma * kHeightUnit_m * samples.quantile(0.5);
  return found;
}

void mark_face(ImageView<const std::uint16_t> heights, const Region& region, double min_height_m, BitImage& faces) {
  HeightSamples own = inside_of(heights, region);
  if (own.count == 0) return;
  HeightSamples beside = around(heights, region);
  const double base = beside.count < kMinSurroundings ? -kMaxHeight_m : height_of(beside.quantile(0.5));
  const double high = height_of(own.quantile(kFaceQuantile));
  if (high - base < min_height_m) return;
  HeightSamples face;
  for (std::size_t i = 0; i < own.count; ++i) {
    if (height_of(own.height[i]) > 0.5 * (high + base)) face.add(own.height[i]);
  }
  const double halfway = 0.5 * (height_of(face.quantile(0.5)) + base);
  const auto minimum = static_cast<std::int32_t>(std::floor(halfway / kHeightUnit_m)) + kHeightZero;
  for (std::int32_t v = region.top; v <= region.bottom; ++v) {
    for (std::int32_t u = region.left; u <= region.right; ++u) {
      if (heights.at(u, v) != kNoHeight && heights.at(u, v) > minimum) faces.set(u, v);
    }
  }
}

}  // namespace pharos::tof
