// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "host/vision/pointing/pointing_refusal.hpp"
#include "pharos/base/image_view.hpp"
#include "pharos/base/result.hpp"

namespace pharos::pointing {

/// A rectangle of the image.
struct Box {
  std::int32_t left = 0, top = 0, width = 0, height = 0;
};

/// The target against the sky.
struct TargetMask {
  double sky = 0.0;                ///< median grey value of the sky
  double noise = 0.0;              ///< its standard deviation
  double threshold = 0.0;          ///< Otsu's between sky and target
  bool has_brighter_star = false;  ///< a small object is brighter than most of the target
  Box box;                         ///< the target with a margin of sky
  std::vector<std::uint8_t> mask;  ///< of the box, row by row: 1 where the target is

  bool at(std::int32_t u, std::int32_t v) const {
    const std::int32_t x = u - box.left, y = v - box.top;
    if (x < 0 || y < 0 || x >= box.width || y >= box.height) return false;
    return mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(box.width) + static_cast<std::size_t>(x)] != 0;
  }
};

/// Otsu's threshold (1979) of values in a histogram of equal steps: the last bin of the lower class.
int otsu(const std::vector<std::uint32_t>& histogram);

/// Separates the target from sky and stars: pixels above the sky's noise, the largest connected component and others of
/// similar size, then Otsu's threshold between the square roots (evens out shot noise) of its box's values.
Result<TargetMask, PointingRefusal> find_target(ImageView<const std::uint16_t> image);

}  // namespace pharos::pointing
