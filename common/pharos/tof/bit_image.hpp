// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/tof/tof_frame.hpp"

namespace pharos::tof {

/// A mask of one bit a pixel, 64 pixels a word: morphology costs a few instructions a word.
class BitImage {
 public:
  /// All clear; the size is limited to kMaxWidth_px x kMaxHeight_px.
  void reset(std::int32_t width_px, std::int32_t height_px);

  std::int32_t width_px() const { return width_; }
  std::int32_t height_px() const { return height_; }
  bool at(std::int32_t u, std::int32_t v) const { return ((word(u, v) >> bit(u)) & 1U) != 0; }
  bool contains(std::int32_t u, std::int32_t v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }
  /// The 64 pixels that hold column u, the first in the lowest bit; none beyond the image may be set.
  void put(std::int32_t u, std::int32_t v, std::uint64_t pixels) { word(u, v) = pixels; }
  void set(std::int32_t u, std::int32_t v) { word(u, v) |= std::uint64_t{1} << bit(u); }
  void clear(std::int32_t u, std::int32_t v) { word(u, v) &= ~(std::uint64_t{1} << bit(u)); }

  /// The first column from `u` on that is set in row v; width_px() where there is none.
  std::int32_t next_set(std::int32_t u, std::int32_t v) const;

  // With a square of 3 x 3 pixels; beyond the border nothing is set. `out` becomes the result.
  void erode(BitImage& out) const;
  void dilate(BitImage& out) const;

 private:
  static constexpr std::int32_t kWords = kMaxWidth_px / 64;
  static_assert(kWords * 64 == kMaxWidth_px);

  static unsigned bit(std::int32_t u) { return static_cast<unsigned>(u) & 63U; }
  // Of word k of row v.
  static std::size_t index(std::int32_t k, std::int32_t v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(kWords) + static_cast<std::size_t>(k);
  }
  std::uint64_t& word(std::int32_t u, std::int32_t v) { return words_[index(u / 64, v)]; }
  const std::uint64_t& word(std::int32_t u, std::int32_t v) const { return words_[index(u / 64, v)]; }
  template <class Join>
  void with_neighbours(BitImage& out, Join join) const;

  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  std::array<std::uint64_t, static_cast<std::size_t>(kWords* kMaxHeight_px)> words_{};
};

/// Opens, which removes protrusions and isolated points narrower than three pixels (paper 000, 2.2.2), then closes
/// holes and gaps of up to two pixels. In place. In the other order noise pixels would merge before they are removed.
void open_and_close(BitImage& mask, BitImage& scratch);

}  // namespace pharos::tof
