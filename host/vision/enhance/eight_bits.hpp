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
/// Enhancer, else the upper half of each value.
class EightBitPairs {
 public:
  /// Empty: frames as they come.
  explicit EightBitPairs(const std::optional<EnhanceSettings>& settings = {});

  /// The frame of camera `side` (0 or 1); holds until the next of that side.
  ImageView<const std::uint8_t> of(ImageView<const std::uint16_t> frame, std::size_t side);

 private:
  bool enhanced_;
  std::array<Enhancer, 2> enhancers_;
  std::array<std::vector<std::uint8_t>, 2> out_;
};

}  // namespace pharos::enhance
