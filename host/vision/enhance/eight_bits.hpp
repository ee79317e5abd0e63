// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/vision/enhance/enhancer.hpp"

namespace pharos::enhance {

/// Frames of two cameras as an 8-bit consumer takes them: enhanced where that is asked for, each camera with its own
/// Enhancer and thread (same bits as one after the other), else the upper half of each value.
class EightBitPairs {
 public:
  /// Empty: frames as they come.
  explicit EightBitPairs(const std::optional<EnhanceSettings>& settings = {});

  /// The left and the right frame; hold until the next call.
  std::array<ImageView<const std::uint8_t>, 2> both(ImageView<const std::uint16_t> left,
                                                    ImageView<const std::uint16_t> right);

 private:
  ImageView<const std::uint8_t> of(ImageView<const std::uint16_t> frame, std::size_t side);

  bool enhanced_;
  std::array<Enhancer, 2> enhancers_;
  std::array<std::vector<std::uint8_t>, 2> out_;
};

}  // namespace pharos::enhance
