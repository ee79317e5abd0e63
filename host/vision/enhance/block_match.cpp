// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/block_match.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "host/vision/enhance/wide_vectors.hpp"

namespace pharos::enhance {
namespace {

// In a form for which compilers use the processor's own instruction.
std::uint32_t difference(const std::uint8_t* a, const std::uint8_t* b) {
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < kBlockPixels; ++k) sum += static_cast<std::uint32_t>(std::abs(int{a[k]} - int{b[k]}));
  return sum;
}

}  // namespace

PHAROS_WIDE_VECTORS void BlockMatcher::look_at(ImageView<const float> image, std::int32_t first, std::int32_t last,
                                               float low, float high) {
  constexpr auto kSide = static_cast<std::int32_t>(kBlock_px);
  first_ = first;
  rows_ = last - first;
  columns_ = image.width_px - kSide + 1;
  step_ = std::max(high - low, 1e-6F) / 255.0F;
  strips_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) * kBlock_px);
  row_.resize(static_cast<std::size_t>(image.width_px));
  for (std::int32_t v = first; v < last; ++v) {
    const float* from = image.row(v);
    for (std::int32_t u = 0; u < image.width_px; ++u) {
      row_[static_cast<std::size_t>(u)] =
          static_cast<std::uint8_t>(std::clamp((from[u] - low) / step_ + 0.5F, 0.0F, 255.0F));
    }
    std::uint8_t* to = strips_.data() + static_cast<std::size_t>(v - first) * kBlock_px;
    for (std::int32_t u = 0; u < columns_; ++u) {
      std::memcpy(to, row_.data() + u, kBlock_px);
      to += static_cast<std::size_t>(rows_) * kBlock_px;
    }
  }
}

PHAROS_WIDE_VECTORS std::span<const BlockPlace> BlockMatcher::find(BlockPlace reference,
                                                                   const MatchSettings& settings) {
  const std::uint8_t* wanted = block(reference.u_px, reference.v_px);
  std::array<std::uint8_t, kBlockPixels> pattern;
  std::copy_n(wanted, kBlockPixels, pattern.begin());
  const std::size_t maximum = settings.max_blocks;
  const auto limit = static_cast<std::uint32_t>(settings.max_difference / step_ * static_cast<float>(kBlockPixels));
  found_[0] = reference;
  difference_[0] = 0;
  std::size_t count = 1;
  std::uint32_t worst = limit;
  const auto last_v = first_ + rows_ - static_cast<std::int32_t>(kBlock_px);
  const std::int32_t v0 = std::max(first_, reference.v_px - settings.reach_px);
  const std::int32_t v1 = std::min(last_v, reference.v_px + settings.reach_px);
  const std::int32_t u0 = std::max(0, reference.u_px - settings.reach_px);
  const std::int32_t u1 = std::min(columns_ - 1, reference.u_px + settings.reach_px);
  for (std::int32_t u = u0; u <= u1; ++u) {
    const std::uint8_t* candidate = block(u, v0);
    for (std::int32_t v = v0; v <= v1; ++v, candidate += kBlock_px) {
      const std::uint32_t sum = difference(pattern.data(), candidate);
      if (sum >= worst || candidate == wanted) continue;
      std::size_t at = std::min(count, maximum - 1);
      for (; at > 1 && difference_[at - 1] > sum; --at) {
        difference_[at] = difference_[at - 1];
        found_[at] = found_[at - 1];
      }
      difference_[at] = sum;
      found_[at] = {u, v};
      if (count < maximum) ++count;
      if (count == maximum) worst = std::min(limit, difference_[maximum - 1]);
    }
  }
  return {found_.data(), std::bit_floor(count)};
}

}  // namespace pharos::enhance
