// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "host/vision/enhance/block_match.hpp"
#include "host/vision/enhance/block_transform.hpp"

namespace pharos::enhance {

/// Coefficients of up to kMaxBlocks blocks, one after another.
using Stack = std::array<float, kMaxBlocks * kBlockPixels>;

template <BlockTransform kind>
void gather(ImageView<const float> image, std::span<const BlockPlace> places, Stack& stack) {
  float* to = stack.data();
  for (const BlockPlace& place : places) {
    forward_transform<kind>(&image.at(place.u_px, place.v_px), image.stride_px, to);
    to += kBlockPixels;
  }
}

template <BlockTransform kind>
void back_to_pixels(Stack& stack, std::size_t blocks) {
  for (std::size_t k = 0; k < blocks; ++k) inverse_transform<kind>(stack.data() + k * kBlockPixels);
}

/// First step: coefficients below 2.8 sigma are noise. Returns the weight of the stack, one over the number kept.
inline float shrink_hard(Stack& stack, std::size_t blocks, float sigma) {
  constexpr float kThreshold = 2.8F;  // of 2.5 to 3.1, best over images and noise; the authors' is 2.7
  hadamard(stack.data(), blocks);
  const float threshold = kThreshold * sigma * std::sqrt(static_cast<float>(blocks));
  const float scale = 1.0F / static_cast<float>(blocks);
  std::int32_t kept = 0;
  for (std::size_t k = 0; k < blocks * kBlockPixels; ++k) {
    const bool keep = std::abs(stack[k]) > threshold;
    kept += keep ? 1 : 0;
    stack[k] = keep ? scale * stack[k] : 0.0F;
  }
  hadamard(stack.data(), blocks);
  return 1.0F / static_cast<float>(std::max(1, kept));
}

/// Second step: multiplies each coefficient by the signal's fraction in the first result, `pilot`, which is
/// overwritten. Returns the weight of the stack, one over the sum of the squared fractions.
inline float shrink_wiener(Stack& stack, Stack& pilot, std::size_t blocks, float sigma) {
  hadamard(stack.data(), blocks);
  hadamard(pilot.data(), blocks);
  const float noise = sigma * sigma * static_cast<float>(blocks);
  const float scale = 1.0F / static_cast<float>(blocks);
  for (std::size_t k = 0; k < blocks * kBlockPixels; ++k) {
    const float power = pilot[k] * pilot[k];
    const float fraction = power / (power + noise);
    pilot[k] = fraction * fraction;
    stack[k] *= fraction * scale;
  }
  std::array<float, kBlock_px> part{};
  for (std::size_t k = 0; k < blocks * kBlockPixels; k += kBlock_px) {
    for (std::size_t lane = 0; lane < kBlock_px; ++lane) part[lane] += pilot[k + lane];
  }
  float sum = 0.0F;
  for (const float value : part) sum += value;
  hadamard(stack.data(), blocks);
  return 1.0F / std::max(sum, 1e-3F);
}

}  // namespace pharos::enhance
