// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "host/vision/enhance/float_image.hpp"

namespace pharos::test {

/// A box with stripes and a disc in front of a black background, lit from the left: edges, texture, gradients and flat
/// parts.
inline enhance::FloatImage painted_target(std::int32_t width, std::int32_t height, float light) {
  enhance::FloatImage image;
  image.shape(width, height, 1);
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < width; ++u) {
      const float x = static_cast<float>(u) / static_cast<float>(width);
      const float y = static_cast<float>(v) / static_cast<float>(height);
      float value = 0.0F;
      if (x > 0.2F && x < 0.8F && y > 0.2F && y < 0.8F) {
        value = 0.4F + 0.3F * std::sin(60.0F * x) * std::sin(25.0F * y) + 0.3F * (u / 9 % 2 == 0 ? 1.0F : 0.0F);
        if (std::hypot(x - 0.5F, y - 0.5F) < 0.12F) value = 0.9F;
      }
      image.view().at(u, v) = light * value * (1.0F - 0.6F * x);
    }
  }
  return image;
}

inline void add_noise(enhance::FloatImage& image, double sigma, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, static_cast<float>(sigma));
  for (float& value : image.values) value += noise(random);
}

/// The same image quantised to 8 bits.
inline void round_to_8_bits(enhance::FloatImage& image) {
  for (float& value : image.values) value = std::round(std::clamp(value, 0.0F, 1.0F) * 255.0F) / 255.0F;
}

inline double rms_difference(const enhance::FloatImage& a, const enhance::FloatImage& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    const double off = static_cast<double>(a.values[k]) - static_cast<double>(b.values[k]);
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

}  // namespace pharos::test
