// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pharos/base/image_view.hpp"

namespace pharos::enhance {

/// An image of floats, 1 = white. One plane (grey) or three (red, green, blue), one after the other, rows without gaps.
struct FloatImage {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  int channels = 1;
  std::vector<float> values;

  /// Sets the size; the pixels are not initialised.
  void shape(std::int32_t width, std::int32_t height, int planes) {
    width_px = width;
    height_px = height;
    channels = planes;
    values.resize(pixels() * static_cast<std::size_t>(planes));
  }
  std::size_t pixels() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px); }
  float* plane(int channel) { return values.data() + static_cast<std::size_t>(channel) * pixels(); }
  const float* plane(int channel) const { return values.data() + static_cast<std::size_t>(channel) * pixels(); }
  ImageView<const float> view(int channel = 0) const { return {plane(channel), width_px, height_px}; }
  ImageView<float> view(int channel = 0) { return {plane(channel), width_px, height_px}; }
};

/// 255 or 65535 becomes 1. `out` takes the shape of `in`, one plane.
void to_floats(ImageView<const std::uint8_t> in, FloatImage& out);
void to_floats(ImageView<const std::uint16_t> in, FloatImage& out);

/// Rounded and clipped to 0 ... 255 or 65535; both of one size.
void to_integers(ImageView<const float> in, ImageView<std::uint8_t> out);
void to_integers(ImageView<const float> in, ImageView<std::uint16_t> out);

}  // namespace pharos::enhance
