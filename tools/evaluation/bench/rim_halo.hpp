// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::tools {

/// What a filter does around the rim of a target before a black ground, as shares of white.
struct RimHalo {
  /// A glow: over rings 3 to 12 px outside, the most that a ring's mean is off the ground's beyond 20 px.
  double outside = 0.0;
  /// An edging: over rings 3 to 10 px inside, the most that a ring is off, in the mean, what pixels as light become at
  /// least 16 px inside and at most 26 px away. Below 0: darker.
  double inside = 0.0;
};

/// `filtered` beside `even`, the same view in light that is even and strong enough to tell target from ground (without
/// stars). Images of one size; without target or ground 0. Some 0.1 s an image of 640 x 480.
RimHalo rim_halo(ImageView<const std::uint8_t> filtered, ImageView<const std::uint16_t> even);

}  // namespace pharos::tools
