// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/vision/enhance/block_transform.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::enhance {

/// Most blocks of a stack.
inline constexpr std::size_t kMaxBlocks = 16;

/// Upper left pixel of a block.
struct BlockPlace {
  std::int32_t u_px = 0, v_px = 0;
};

struct MatchSettings {
  std::int32_t reach_px = 19;    ///< of the search, to each side of the reference
  std::size_t max_blocks = 16;   ///< a power of two
  float max_difference = 0.24F;  ///< largest mean absolute difference of matching blocks, 1 = white
};

/// Finds the blocks most similar to a given one, by the sum of absolute differences of 8-bit values.
class BlockMatcher {
 public:
  /// Rows `first` to `last` (not included) of the image, stretched so that `low` to `high` fill the 8 bits.
  void look_at(ImageView<const float> image, std::int32_t first, std::int32_t last, float low, float high);

  /// The reference itself first, then others; their number is a power of two. Positions in the whole image.
  std::span<const BlockPlace> find(BlockPlace reference, const MatchSettings& settings);

 private:
  const std::uint8_t* block(std::int32_t u, std::int32_t v) const {
    return strips_.data() +
           (static_cast<std::size_t>(u) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(v - first_)) *
               kBlock_px;
  }

  // For each column u, the eight values from u on of every row: a block is 64 contiguous bytes.
  std::vector<std::uint8_t> strips_;
  std::vector<std::uint8_t> row_;
  std::int32_t first_ = 0, rows_ = 0, columns_ = 0;
  float step_ = 1.0F;
  std::array<BlockPlace, kMaxBlocks> found_;
  std::array<std::uint32_t, kMaxBlocks> difference_;
};

}  // namespace pharos::enhance
