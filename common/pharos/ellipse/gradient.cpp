// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/gradient.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace pharos::ellipse {
namespace {

// Magnitudes are counted in classes of 1/8 octave; that is as finely as a threshold needs to be known.
constexpr int kFraction = 3;
constexpr std::size_t kClasses = 16U << kFraction;
constexpr std::int32_t kRowStep = 4;

// Rayleigh: the median length of a gradient of pure noise is 1.177 sigma.
constexpr float kSigmaOfMedian = 1.0F / 1.177F;
// Noise alone passes the higher threshold at 3 pixels of 10^7 (exp(-5.5^2/2)).
constexpr float kHighSigmas = 5.5F;
constexpr float kLowSigmas = 2.75F;
// Beside the strongest edges these are texture: shares of the magnitude that 2 of 1000 pixels exceed.
constexpr float kHighShare = 0.06F;
constexpr float kLowShare = 0.03F;
constexpr std::uint32_t kStrongest = 500;
// An edge is one or two points wide; its slopes above the threshold are about three times as many pixels.
constexpr std::uint32_t kPixelsPerPoint = 2;

using Histogram = std::array<std::uint32_t, kClasses>;

std::size_t class_of(std::uint16_t magnitude) {
  const int octave = static_cast<int>(std::bit_width(static_cast<unsigned>(magnitude))) - 1;
  if (octave < kFraction) return magnitude;
  return (static_cast<std::size_t>(octave) << kFraction) |
         (static_cast<unsigned>(magnitude) >> (octave - kFraction) & 7U);
}

std::uint16_t lower_end(std::size_t index) {
  const std::size_t octave = index >> kFraction;
  if (octave < kFraction) return static_cast<std::uint16_t>(index);
  return static_cast<std::uint16_t>((8U | (index & 7U)) << (octave - kFraction));
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

EdgeThresholds adaptive_thresholds(ImageView<const std::uint16_t> magnitude, std::uint32_t most_points) {
  Histogram histogram{};
  std::uint32_t counted = 0;
  for (std::int32_t v = 1; v < magnitude.height_px - 1; v += kRowStep) {
    const std::uint16_t* row = magnitude.row(v);
    for (std::int32_t u = 1; u < magnitude.width_px - 1; ++u) ++histogram[class_of(row[u])];
    counted += static_cast<std::uint32_t>(magnitude.width_px - 2);
  }
  const float sigma =
      kSigmaOfMedian * static_cast<float>(exceeded_by(histogram, std::max<std::uint32_t>(1, counted / 2)));
  const auto strong = static_cast<float>(exceeded_by(histogram, std::max<std::uint32_t>(1, counted / kStrongest)));
  const auto crowded = static_cast<float>(exceeded_by(
      histogram, std::max<std::uint32_t>(1, kPixelsPerPoint * most_points / static_cast<std::uint32_t>(kRowStep))));
  const float low = std::max({kLowSigmas * sigma, kLowShare * strong, crowded, 1.0F});
  const float high = std::max({kHighSigmas * sigma, kHighShare * strong, low + 1.0F});
  const auto limited = [](float value) { return static_cast<std::uint16_t>(std::min(value, 65535.0F)); };
  return {limited(low), limited(high)};
}

}  // namespace pharos::ellipse
