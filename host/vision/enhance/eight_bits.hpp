// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/vision/enhance/enhancer.hpp"

namespace pharos::enhance {

/// Converts frames of two cameras to 8 bits: enhanced where configured, each camera with its own Enhancer and thread
/// (result identical to sequential processing), else the upper half of each value.
class EightBitPairs {
 public:
  /// Empty: frames are not enhanced.
  explicit EightBitPairs(const std::optional<EnhanceSettings>& settings = {});

  /// The left and the right frame; valid until the next call.
  std::array<ImageView<const std::uint8_t>, 2> both(ImageView<const std::uint16_t> left,
                                                    ImageView<const std::uint16_t> right);

 private:
  ImageView<const std::uint8_t> of(ImageView<const std::uint16_t> frame, std::size_t side);

  bool enhanced_;
  std::array<Enhancer, 2> enhancers_;
  std::array<std::vector<std::uint8_t>, 2> out_;
};

}  // namespace pharos::enhance
