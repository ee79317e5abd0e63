// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::slam {

/// Scales of the image pyramid: each 1.2 times coarser (ORB's own default).
inline constexpr int kLevels = 8;
inline constexpr double kLevelScale = 1.2;
inline constexpr std::array<double, kLevels> kScales = [] {
  std::array<double, kLevels> scales{};
  double scale = 1.0;
  for (double& of_level : scales) {
    of_level = scale;
    scale *= kLevelScale;
  }
  return scales;
}();
inline double scale_of(int level) { return kScales[static_cast<std::size_t>(level)]; }

/// A level of an image's pyramid; level 0 is the image itself. Pixel centres: x of a level corresponds to (x + 0.5) s -
/// 0.5 of the image, where s is the ratio of their widths (heights).
struct PyramidLevel {
  ImageView<const std::uint8_t> image;
};

/// Conversion of image positions to those on a level, and back.
class LevelPlaces {
 public:
  LevelPlaces(const std::vector<PyramidLevel>& pyramid, int level) {
    const ImageView<const std::uint8_t>&image = pyramid[0].image,
                          &there = pyramid[static_cast<std::size_t>(level)].image;
    scale_u_ = static_cast<double>(image.width_px) / there.width_px;
    scale_v_ = static_cast<double>(image.height_px) / there.height_px;
  }
  double scale() const { return scale_u_; }  ///< of the widths
  double column(double u_px) const { return (u_px + 0.5) / scale_u_ - 0.5; }
  Vector2 on_level(const Vector2& pixel) const { return {column(pixel.x()), (pixel.y() + 0.5) / scale_v_ - 0.5}; }
  double image_column(double column) const { return (column + 0.5) * scale_u_ - 0.5; }
  Vector2 in_image(const Vector2& place) const { return {image_column(place.x()), (place.y() + 0.5) * scale_v_ - 0.5}; }

 private:
  double scale_u_, scale_v_;
};

}  // namespace pharos::slam
