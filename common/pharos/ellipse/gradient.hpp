// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::ellipse {

/// Half the central difference of the smoothed image: fits 16 bits for any image.
struct Gradient {
  std::int16_t u = 0;
  std::int16_t v = 0;
};

/// At an inner pixel.
inline Gradient gradient_at(ImageView<const std::uint16_t> smoothed, std::int32_t u, std::int32_t v) {
  const std::uint16_t* row = smoothed.row(v);
  return {static_cast<std::int16_t>((row[u + 1] >> 1) - (row[u - 1] >> 1)),
          static_cast<std::int16_t>((smoothed.row(v + 1)[u] >> 1) - (smoothed.row(v - 1)[u] >> 1))};
}

/// Length of the gradient at every pixel, within 3 % (octagonal norm, integers only); 0 along the border.
void gradient_magnitude(ImageView<const std::uint16_t> smoothed, ImageView<std::uint16_t> magnitude);

/// Canny's two thresholds on the magnitude.
struct EdgeThresholds {
  std::uint16_t low = 0;   /// an edge continues down to this
  std::uint16_t high = 0;  /// and must reach this at some point
  float noise = 0.0F;      /// sigma of the noise's gradient, each component
};

/// Thresholds for this image: above its noise, estimated from the median magnitude (most of an image has no edge), and
/// above a fraction of its strongest edges. They rise until no more than `max_points` pixels can pass the lower one.
EdgeThresholds adaptive_thresholds(ImageView<const std::uint16_t> magnitude, std::uint32_t max_points);

}  // namespace pharos::ellipse
