// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::tools {

/// Effect of a filter around the rim of a target in front of a black background, as fractions of white.
struct RimHalo {
  /// Glow: over rings 3 to 12 px outside, the maximum difference of a ring's mean from the background beyond 20 px.
  double outside = 0.0;
  /// Edging: over rings 3 to 10 px inside, the maximum mean difference of a ring from the result of equally bright
  /// pixels at least 16 px inside and at most 26 px away. Negative: darker.
  double inside = 0.0;
};

/// Compares `filtered` with `even`, the same view in uniform light that is strong enough to separate target from
/// background (without stars). Images of one size; 0 without target or background. Some 0.1 s an image of 640 x 480.
RimHalo rim_halo(ImageView<const std::uint8_t> filtered, ImageView<const std::uint16_t> even);

}  // namespace pharos::tools
