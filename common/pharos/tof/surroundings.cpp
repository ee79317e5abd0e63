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

struct Samples {
  std::array<double, kMostSamples> height_m{};
  std::size_t count = 0;

  void add(double value) {
    if (count < kMostSamples) height_m[count++] = value;
  }
  double quantile(double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(count - 1));
    std::nth_element(height_m.begin(), height_m.begin() + place, height_m.begin() + static_cast<std::ptrdiff_t>(count));
    return height_m[static_cast<std::size_t>(place)];
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
      samples.add(height_of(heights.at(u, v)));
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
      samples.add(height_of(heights.at(u, v)));
    }
  }
  around.samples = samples.count;
  if (samples.count < kLeastSurroundings) return around;
  around.foot_m = samples.quantile(0.5);
  for (std::size_t i = 0; i < samples.count; ++i) {
    samples.height_m[i] = std::fabs(samples.height_m[i] - around.foot_m);
  }
  around.sigma_m = kMedianToSigma * samples.quantile(0.5);
  return around;
}

void mark_face(ImageView<const std::uint16_t> heights, const Region& region, double least_height_m, BitImage& faces) {
  const Surroundings around = surroundings_of(heights, region);
  Samples own = inside_of(heights, region);
  if (own.count == 0) return;
  const double foot = around.samples < kLeastSurroundings ? -kMostHeight_m : around.foot_m;
  const double high = own.quantile(kFaceQuantile);
  if (high - foot < least_height_m) return;
  Samples face;
  for (std::size_t i = 0; i < own.count; ++i) {
    if (own.height_m[i] > 0.5 * (high + foot)) face.add(own.height_m[i]);
  }
  const double halfway = 0.5 * (face.quantile(0.5) + foot);
  for (std::int32_t v = region.top; v <= region.bottom; ++v) {
    for (std::int32_t u = region.left; u <= region.right; ++u) {
      if (heights.at(u, v) != kNoHeight && height_of(heights.at(u, v)) > halfway) faces.set(u, v);
    }
  }
}

}  // namespace pharos::tof
