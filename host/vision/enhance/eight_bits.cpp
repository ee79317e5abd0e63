// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/eight_bits.hpp"

#include <future>

namespace pharos::enhance {

EightBitPairs::EightBitPairs(const std::optional<EnhanceSettings>& settings) : enhanced_(settings.has_value()) {
  if (!settings) return;
  EnhanceSettings one_core = *settings;
  one_core.threads = 1;
  for (Enhancer& enhancer : enhancers_) enhancer = Enhancer(one_core);
}

std::array<ImageView<const std::uint8_t>, 2> EightBitPairs::both(ImageView<const std::uint16_t> left,
                                                                 ImageView<const std::uint16_t> right) {
  if (!enhanced_) return {of(left, 0), of(right, 1)};
  auto other = std::async(std::launch::async, [&] { return of(right, 1); });
  const ImageView<const std::uint8_t> first = of(left, 0);
  return {first, other.get()};
}

ImageView<const std::uint8_t> EightBitPairs::of(ImageView<const std::uint16_t> frame, std::size_t side) {
  std::vector<std::uint8_t>& out = out_[side];
  out.resize(frame.pixels());
  const ImageView<std::uint8_t> view(out.data(), frame.width_px, frame.height_px);
  if (enhanced_) {
    to_integers(enhancers_[side].enhance(frame).result.view(), view);
  } else {
    for (std::int32_t v = 0; v < frame.height_px; ++v) {
      for (std::int32_t u = 0; u < frame.width_px; ++u)
        view.row(v)[u] = static_cast<std::uint8_t>(frame.row(v)[u] >> 8);
    }
  }
  return {out.data(), frame.width_px, frame.height_px};
}

}  // namespace pharos::enhance
