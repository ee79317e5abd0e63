// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/float_image.hpp"

#include <algorithm>
#include <limits>

namespace pharos::enhance {
namespace {

template <class Integer>
void widen(ImageView<const Integer> in, FloatImage& out) {
  constexpr float kStep = 1.0F / static_cast<float>(std::numeric_limits<Integer>::max());
  out.shape(in.width_px, in.height_px, 1);
  for (std::int32_t v = 0; v < in.height_px; ++v) {
    float* to = out.view().row(v);
    for (std::int32_t u = 0; u < in.width_px; ++u) to[u] = kStep * static_cast<float>(in.row(v)[u]);
  }
}

template <class Integer>
void narrow(ImageView<const float> in, ImageView<Integer> out) {
  constexpr auto kMax = static_cast<float>(std::numeric_limits<Integer>::max());
  for (std::int32_t v = 0; v < in.height_px; ++v) {
    for (std::int32_t u = 0; u < in.width_px; ++u) {
      out.row(v)[u] = static_cast<Integer>(std::clamp(in.row(v)[u], 0.0F, 1.0F) * kMax + 0.5F);
    }
  }
}

}  // namespace

void to_floats(ImageView<const std::uint8_t> in, FloatImage& out) { widen(in, out); }
void to_floats(ImageView<const std::uint16_t> in, FloatImage& out) { widen(in, out); }
void to_integers(ImageView<const float> in, ImageView<std::uint8_t> out) { narrow(in, out); }
void to_integers(ImageView<const float> in, ImageView<std::uint16_t> out) { narrow(in, out); }

}  // namespace pharos::enhance
