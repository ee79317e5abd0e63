// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::ellipse {

/// A point where the image changes most along its gradient, to a fraction of a pixel.
struct EdgePoint {
  float u_px = 0.0F;
  float v_px = 0.0F;
  std::int16_t gradient_u = 0;  ///< towards brighter; the unit is that of the smoothed image
  std::int16_t gradient_v = 0;
  std::uint16_t column = 0;  /// the pixel in which it was found
  std::uint16_t row = 0;
};

}  // namespace pharos::ellipse
