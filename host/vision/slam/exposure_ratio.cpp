// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/exposure_ratio.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::slam {
namespace {

constexpr double kEqualWithin = 0.08;  // enhanced frames of equal cameras differ by 0.05
// Two views of one object differ in contrast by up to this factor without any difference in exposure.
constexpr double kOfViews = 0.25;
constexpr double kMax = 4.0;
constexpr std::size_t kMinSquares = 40;
constexpr int kReach_px = 5;

// Standard deviation of an image's values, of each `step`-th pixel of each `step`-th row.
double contrast(ImageView<const std::uint8_t> image, int step) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::int32_t v = 0; v < image.height_px; v += step) {
    for (std::int32_t u = 0; u < image.width_px; u += step) {
      const double value = image.at(u, v);
      sum += value;
      squares += value * value;
      ++count;
    }
  }
  return count > 0.0 ? std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count))) : 0.0;
}

// Standard deviation of the square around a position of the whole image, on its level; empty at the border.
std::optional<double> contrast_at(const Vector2& pixel, const PyramidLevel& level, const PyramidLevel& whole) {
  const double scale = static_cast<double>(level.image.width_px) / whole.image.width_px;
  const auto u = static_cast<std::int32_t>(std::lround((pixel.x() + 0.5) * scale - 0.5)) - kReach_px;
  const auto v = static_cast<std::int32_t>(std::lround((pixel.y() + 0.5) * scale - 0.5)) - kReach_px;
  constexpr std::int32_t kSide_px = 2 * kReach_px + 1;
  if (u < 0 || v < 0 || u + kSide_px > level.image.width_px || v + kSide_px > level.image.height_px)
    return std::nullopt;
  return contrast({level.image.row(v) + u, kSide_px, kSide_px, level.image.stride_px}, 1);
}

}  // namespace

double ExposureRatio::of(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) const {
  if (ratio_) return std::abs(*ratio_ - 1.0) < kEqualWithin ? 1.0 : *ratio_;
  constexpr int kEvery_px = 4;
  const double of_left = contrast(left, kEvery_px), of_right = contrast(right, kEvery_px);
  if (!(of_left > 0.0 && of_right > 0.0)) return 1.0;
  const double guess = std::clamp(of_left / of_right, 1.0 / kMax, kMax);
  return std::abs(std::log(guess)) < kOfViews ? 1.0 : guess;
}

void ExposureRatio::learn(double applied, const std::vector<Feature>& features, const std::vector<PyramidLevel>& left,
                          const std::vector<PyramidLevel>& right) {
  std::vector<double> ratios;
  for (const Feature& feature : features) {
    if (!feature.stereo()) continue;
    const auto level = static_cast<std::size_t>(feature.level);
    const auto here = contrast_at(feature.pixel, left[level], left[0]);
    const auto there = contrast_at({feature.right_u_px, feature.pixel.y()}, right[level], right[0]);
    if (here && there && *there > 0.0) ratios.push_back(*here / *there);
  }
  ratio_.reset();
  if (ratios.size() < kMinSquares) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  ratio_ = std::clamp(applied * *middle, 1.0 / kMax, kMax);
}

}  // namespace pharos::slam
