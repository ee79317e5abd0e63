// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/tone_curve.hpp"

#include <cmath>

#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

double tone_power(std::uint64_t seed) { return RandomStream(seed, "tone curve").uniform(0.45, 0.6); }

void apply_tone_curve(host::GreyImage& image, double power) {
  if (power == 1.0) return;
  const double largest = image.bits == 8 ? 255.0 : 65535.0;
  const double step = 65535.0 / largest;
  for (std::uint16_t& pixel : image.pixels) {
    pixel = static_cast<std::uint16_t>(step * std::round(largest * std::pow(pixel / 65535.0, power)));
  }
}

}  // namespace pharos::sim
