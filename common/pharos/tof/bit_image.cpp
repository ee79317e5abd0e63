// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/bit_image.hpp"

#include <algorithm>
#include <bit>

namespace pharos::tof {

void BitImage::reset(std::int32_t width_px, std::int32_t height_px) {
  width_ = std::clamp<std::int32_t>(width_px, 0, kMaxWidth_px);
  height_ = std::clamp<std::int32_t>(height_px, 0, kMaxHeight_px);
  std::fill_n(words_.begin(), index(0, height_), std::uint64_t{0});
}

std::int32_t BitImage::next_set(std::int32_t u, std::int32_t v) const {
  std::uint64_t from_here = ~std::uint64_t{0} << bit(u);
  for (std::int32_t k = u / 64; 64 * k < width_; ++k, from_here = ~std::uint64_t{0}) {
    const std::uint64_t rest = word(64 * k, v) & from_here;
    if (rest != 0) return 64 * k + std::countr_zero(rest);
  }
  return width_;
}

template <class Join>
void BitImage::with_neighbours(BitImage& out, Join join) const {
  out.reset(width_, height_);
  const std::int32_t words = (width_ + 63) / 64;
  const std::uint64_t last = width_ % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (width_ % 64)) - 1;
  // Three rows joined; nothing beyond the image.
  const auto column = [&](std::int32_t k, std::int32_t v) -> std::uint64_t {
    if (k < 0 || k >= words) return 0;
    const std::uint64_t above = v > 0 ? words_[index(k, v - 1)] : 0;
    const std::uint64_t below = v + 1 < height_ ? words_[index(k, v + 1)] : 0;
    return join(join(above, words_[index(k, v)]), below);
  };
  for (std::int32_t v = 0; v < height_; ++v) {
    for (std::int32_t k = 0; k < words; ++k) {
      const std::uint64_t here = column(k, v);
      const std::uint64_t left = (here << 1U) | (column(k - 1, v) >> 63U);
      const std::uint64_t right = (here >> 1U) | (column(k + 1, v) << 63U);
      out.words_[index(k, v)] = join(join(left, here), right) & (k + 1 < words ? ~std::uint64_t{0} : last);
    }
  }
}

void BitImage::erode(BitImage& out) const {
  with_neighbours(out, [](std::uint64_t a, std::uint64_t b) { return a & b; });
}

void BitImage::dilate(BitImage& out) const {
  with_neighbours(out, [](std::uint64_t a, std::uint64_t b) { return a | b; });
}

void open_and_close(BitImage& mask, BitImage& scratch) {
  mask.erode(scratch);
  scratch.dilate(mask);
  mask.dilate(scratch);
  scratch.erode(mask);
}

}  // namespace pharos::tof
