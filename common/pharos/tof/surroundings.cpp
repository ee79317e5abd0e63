// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/surroundings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::tof {
namespace {

// How many pixels are looked at, at most.
constexpr std::size_t kMostSamples = 512;
constexpr double kMedianToSigma = 1.4826;
// A face with specks grown on to it is at least a third of its region: this quantile lies on the face.
constexpr double kFaceQuantile = 0.85;

// Counts of the height image.
struct Samples {
  std::array<std::uint16_t, kMostSamples> height{};
  std::size_t count = 0;

  void add(std::uint16_t value) {
    if (count < kMostSamples) height[count++] = value;
  }
  std::uint16_t quantile(double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(count - 1));
    std::nth_element(height.begin(), height.begin() + place, height.begin() + static_cast<std::ptrdiff_t>(count));
    return height[static_cast<std::size_t>(place)];
  }
};

// Of the region's pixels, row by row between its outline; holes are few.
Samples inside_of(ImageView<const std::uint16_t> heights, const Region& region) {
  Samples samples;
  const std::int32_t stride = 1 + region.rows() * region.columns() / static_cast<std::int32_t>(kMostSamples);
  std::int32_t met = 0;
  for (std::int32_t v = region.top; v <= region.bottom; ++v) {
    const Region::Extent& row = region.row[static_cast<std::size_t>(v - region.top)];
    for (std::int32_t u = row.first; u <= row.last; ++u) {
      if (heights.at(u, v) == kNoHeight || met++ % stride != 0) continue;
      samples.add(heights.at(u, v));
    }
  }
  return samples;
}

}  // namespace

Surroundings surroundings_of(ImageView<const std::uint16_t> heights, const Region& region) {
  const std::int32_t reach = std::max<std::int32_t>({6, region.rows(), region.columns()});
  Surroundings around;
  around.stride_px = 1 + reach / 16;
  Samples samples;
  for (std::int32_t v = region.top - reach; v <= region.bottom + reach; v += around.stride_px) {
    for (std::int32_t u = region.left - reach; u <= region.right + reach; u += around.stride_px) {
      const bool own = v >= region.top - 1 && v <= region.bottom + 1 && u >= region.left - 1 && u <= region.right + 1;
      if (own || !heights.contains(u, v) || heights.at(u, v) == kNoHeight) continue;
      samples.add(heights.at(u, v));
    }
  }
  around.samples = samples.count;
  if (samples.count < kLeastSurroundings) return around;
  const std::uint16_t foot = samples.quantile(0.5);
  around.foot_m = height_of(foot);
  for (std::size_t i = 0; i < samples.count; ++i) {
    samples.height[i] = static_cast<std::uint16_t>(std::abs(samples.height[i] - foot));
  }
  around.sigma_m = kMedianToSigma * kHeightUnit_m * samples.quantile(0.5);
  return around;
}

void mark_face(ImageView<const std::uint16_t> heights, const Region& region, double least_height_m, BitImage& faces) {
  const Surroundings around = surroundings_of(heights, region);
  Samples own = inside_of(heights, region);
  if (own.count == 0) return;
  const double foot = around.samples < kLeastSurroundings ? -kMostHeight_m : around.foot_m;
  const double high = height_of(own.quantile(kFaceQuantile));
  if (high - foot < least_height_m) return;
  Samples face;
  for (std::size_t i = 0; i < own.count; ++i) {
    if (height_of(own.height[i]) > 0.5 * (high + foot)) face.add(own.height[i]);
  }
  const double halfway = 0.5 * (height_of(face.quantile(0.5)) + foot);
  const auto least = static_cast<std::int32_t>(std::floor(halfway / kHeightUnit_m)) + kHeightZero;
  for (std::int32_t v = region.top; v <= region.bottom; ++v) {
    for (std::int32_t u = region.left; u <= region.right; ++u) {
      if (heights.at(u, v) != kNoHeight && heights.at(u, v) > least) faces.set(u, v);
    }
  }
}

}  // namespace pharos::tof
