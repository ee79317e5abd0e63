// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/images/grey_image.hpp"

namespace pharos::sim {

/// A seed's own power, 0.45 (1 / 2.2, what screens expect) to 0.6. Drawn from a stream of its own: bodies, light and
/// noise of the seed stay as they are.
double tone_power(std::uint64_t seed);

/// The picture by a camera whose grey values are a power of the light, full well to full well, rounded to its bits.
void apply_tone_curve(host::GreyImage& image, double power);

}  // namespace pharos::sim
