// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/noise_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "host/vision/enhance/block_transform.hpp"

namespace pharos::enhance {
namespace {

constexpr auto kBlockSide = static_cast<std::int32_t>(kBlock_px);
constexpr std::size_t kMinBlocks = 16;
constexpr float kTrace = 1e-5F;  // high frequencies from rounding of floats

struct Block {
  float low = 0.0F;   // energy of the low frequencies, without the mean
  float high = 0.0F;  // mean square of the high ones
};

bool cut_off(ImageView<const float> image, std::int32_t u, std::int32_t v) {
  for (std::int32_t y = v; y < v + kBlockSide; ++y) {
    const auto [low, high] = std::minmax_element(image.row(y) + u, image.row(y) + u + kBlockSide);
    if (*low <= 0.0F || *high >= 1.0F) return true;
  }
  return false;
}

Block measure(const std::array<float, kBlockPixels>& coefficients) {
  Block block;
  int high = 0;
  for (std::size_t k = 1; k < kBlockPixels; ++k) {
    const std::size_t frequency = k / kBlock_px + k % kBlock_px;
    const float power = coefficients[k] * coefficients[k];
    if (frequency < 6) block.low += power;
    if (frequency >= 9) {
      block.high += power;
      ++high;
    }
  }
  block.high /= static_cast<float>(high);
  return block;
}

}  // namespace

double noise_level(ImageView<const float> image) {
  std::vector<Block> blocks;
  std::array<float, kBlockPixels> coefficients;
  for (std::int32_t v = 0; v + kBlockSide <= image.height_px; v += kBlockSide) {
    for (std::int32_t u = 0; u + kBlockSide <= image.width_px; u += kBlockSide) {
      if (cut_off(image, u, v)) continue;
      forward_transform<BlockTransform::kCosine>(&image.at(u, v), image.stride_px, coefficients.data());
      const Block block = measure(coefficients);
      if (block.high > kTrace * kTrace) blocks.push_back(block);
    }
  }
  if (blocks.size() < kMinBlocks) return 0.0;
  const std::size_t plainest = std::max(kMinBlocks, blocks.size() / 10);
  const auto end = blocks.begin() + static_cast<std::ptrdiff_t>(plainest);
  std::nth_element(blocks.begin(), end - 1, blocks.end(), [](const Block& a, const Block& b) { return a.low < b.low; });
  std::nth_element(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(plainest / 2), end,
                   [](const Block& a, const Block& b) { return a.high < b.high; });
  // The median of a mean of 21 squares is 3 % below its expectation.
  constexpr double kMedian = 0.968;
  return std::sqrt(static_cast<double>(blocks[plainest / 2].high) / kMedian);
}

}  // namespace pharos::enhance
