// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/gradient.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace pharos::ellipse {
namespace {

// Magnitudes are counted in classes of 1/8 octave, which is accurate enough for a threshold.
constexpr unsigned kFraction = 3;
constexpr std::size_t kClasses = (17U - kFraction) << kFraction;
constexpr std::int32_t kRowStep = 4;
// Counted in parallel: neighbours are similar, and a counter would wait for the one before it.
constexpr std::int32_t kLanes = 4;

// Rayleigh: the median length of a gradient of pure noise is 1.177 sigma.
constexpr float kSigmaOfMedian = 1.0F / 1.177F;
// Noise alone passes the higher threshold at 3 pixels of 10^7 (exp(-5.5^2/2)).
constexpr float kHighSigmas = 5.5F;
constexpr float kLowSigmas = 2.75F;
// Weaker than the strongest edges by these fractions of the magnitude that 2 of 1000 pixels exceed: texture.
constexpr float kHighFraction = 0.06F;
constexpr float kLowFraction = 0.03F;
constexpr std::uint32_t kStrongest = 500;
// An edge is one or two points wide; its slopes above the threshold are about three times as many pixels.
constexpr std::uint32_t kPixelsPerPoint = 2;

using Histogram = std::array<std::uint32_t, kClasses>;

// Below 16 each magnitude is a class; from there on its four highest bits, eight classes for each further bit.
std::size_t class_of(std::uint16_t magnitude) {
  const unsigned value = magnitude;
  const auto shift = static_cast<unsigned>(std::bit_width(value | 8U)) - 1U - kFraction;
  return (shift << kFraction) + (value >> shift);
}

std::uint16_t lower_end(std::size_t index) {
  if (index < (2U << kFraction)) return static_cast<std::uint16_t>(index);
  return static_cast<std::uint16_t>((8U | (index & 7U)) << ((index >> kFraction) - 1U));
}

Histogram histogram_of(ImageView<const std::uint16_t> magnitude) {
  std::array<Histogram, kLanes> lanes{};
  const std::int32_t last = magnitude.width_px - 1;
  for (std::int32_t v = 1; v < magnitude.height_px - 1; v += kRowStep) {
    const std::uint16_t* row = magnitude.row(v);
    std::int32_t u = 1;
    for (; u + kLanes <= last; u += kLanes) {
      for (std::int32_t k = 0; k < kLanes; ++k) ++lanes[static_cast<std::size_t>(k)][class_of(row[u + k])];
    }
    for (; u < last; ++u) ++lanes[0][class_of(row[u])];
  }
  for (std::size_t k = 1; k < lanes.size(); ++k) {
    for (std::size_t i = 0; i < kClasses; ++i) lanes[0][i] += lanes[k][i];
  }
  return lanes[0];
}

// The magnitude that `count` of the counted pixels exceed.
std::uint16_t exceeded_by(const Histogram& histogram, std::uint32_t count) {
  std::uint32_t above = 0;
  for (std::size_t k = kClasses; k-- > 0;) {
    above += histogram[k];
    if (above >= count) return lower_end(k);
  }
  return 0;
}

}  // namespace

void gradient_magnitude(ImageView<const std::uint16_t> smoothed, ImageView<std::uint16_t> magnitude) {
  const std::int32_t width = smoothed.width_px, height = smoothed.height_px;
  std::fill_n(magnitude.row(0), width, std::uint16_t{0});
  std::fill_n(magnitude.row(height - 1), width, std::uint16_t{0});
  for (std::int32_t v = 1; v < height - 1; ++v) {
    const std::uint16_t *above = smoothed.row(v - 1), *row = smoothed.row(v), *below = smoothed.row(v + 1);
    std::uint16_t* out = magnitude.row(v);
    out[0] = out[width - 1] = 0;
    for (std::int32_t u = 1; u < width - 1; ++u) {
      const auto gu = static_cast<std::int16_t>((row[u + 1] >> 1) - (row[u - 1] >> 1));
      const auto gv = static_cast<std::int16_t>((below[u] >> 1) - (above[u] >> 1));
      const auto au = static_cast<std::int16_t>(gu < 0 ? -gu : gu), av = static_cast<std::int16_t>(gv < 0 ? -gv : gv);
      const std::int16_t more = std::max(au, av), less = std::min(au, av);
      const auto slanted = static_cast<std::uint16_t>(static_cast<std::uint16_t>(more - (more >> 3)) + (less >> 1));
      out[u] = std::max(static_cast<std::uint16_t>(more), slanted);
    }
  }
}

EdgeThresholds adaptive_thresholds(ImageView<const std::uint16_t> magnitude, std::uint32_t max_points) {
  const Histogram histogram = histogram_of(magnitude);
  const std::uint32_t counted = std::accumulate(histogram.begin(), histogram.end(), 0U);
  const float sigma =
      kSigmaOfMedian * static_cast<float>(exceeded_by(histogram, std::max<std::uint32_t>(1, counted / 2)));
  const auto strong = static_cast<float>(exceeded_by(histogram, std::max<std::uint32_t>(1, counted / kStrongest)));
  const auto crowded = static_cast<float>(exceeded_by(
      histogram, std::max<std::uint32_t>(1, kPixelsPerPoint * max_points / static_cast<std::uint32_t>(kRowStep))));
  const float low = std::max({kLowSigmas * sigma, kLowFraction * strong, crowded, 1.0F});
  const float high = std::max({kHighSigmas * sigma, kHighFraction * strong, low + 1.0F});
  const auto limited = [](float value) { return static_cast<std::uint16_t>(std::min(value, 65535.0F)); };
  return {limited(low), limited(high), sigma};
}

}  // namespace pharos::ellipse
