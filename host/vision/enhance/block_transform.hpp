// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>

namespace pharos::enhance {

/// Side of the blocks that the denoisers work on, and their pixels.
inline constexpr std::size_t kBlock_px = 8;
inline constexpr std::size_t kBlockPixels = kBlock_px * kBlock_px;

namespace transform {

// Four columns at a time: one register of every x86-64 and ARM core.
using Four = float __attribute__((vector_size(16)));

inline Four load(const float* from) {
  Four four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}
inline void store(const Four& four, float* to) { std::memcpy(to, &four, sizeof(four)); }

// cos(k pi / 16) / 2, and 1 / sqrt(8) = cos(4 pi / 16) / 2
inline constexpr float kC1 = 0.49039264020161522F, kC2 = 0.46193976625564337F, kC3 = 0.41573480615127262F;
inline constexpr float kC4 = 0.35355339059327379F, kC5 = 0.27778511650980109F, kC6 = 0.19134171618254489F;
inline constexpr float kC7 = 0.09754516100806413F;

// Orthonormal DCT-II of eight values: sums and differences first, then 4 x 4 each.
inline void forward_cosine(Four (&x)[8]) {
  const Four s0 = x[0] + x[7], s1 = x[1] + x[6], s2 = x[2] + x[5], s3 = x[3] + x[4];
  const Four d0 = x[0] - x[7], d1 = x[1] - x[6], d2 = x[2] - x[5], d3 = x[3] - x[4];
  const Four e0 = s0 + s3, e1 = s1 + s2, f0 = s0 - s3, f1 = s1 - s2;
  x[0] = kC4 * (e0 + e1);
  x[4] = kC4 * (e0 - e1);
  x[2] = kC2 * f0 + kC6 * f1;
  x[6] = kC6 * f0 - kC2 * f1;
  x[1] = kC1 * d0 + kC3 * d1 + kC5 * d2 + kC7 * d3;
  x[3] = kC3 * d0 - kC7 * d1 - kC1 * d2 - kC5 * d3;
  x[5] = kC5 * d0 - kC1 * d1 + kC7 * d2 + kC3 * d3;
  x[7] = kC7 * d0 - kC5 * d1 + kC3 * d2 - kC1 * d3;
}

inline void backward_cosine(Four (&x)[8]) {
  const Four e0 = kC4 * (x[0] + x[4]), e1 = kC4 * (x[0] - x[4]);
  const Four f0 = kC2 * x[2] + kC6 * x[6], f1 = kC6 * x[2] - kC2 * x[6];
  const Four s0 = e0 + f0, s3 = e0 - f0, s1 = e1 + f1, s2 = e1 - f1;
  const Four d0 = kC1 * x[1] + kC3 * x[3] + kC5 * x[5] + kC7 * x[7];
  const Four d1 = kC3 * x[1] - kC7 * x[3] - kC1 * x[5] - kC5 * x[7];
  const Four d2 = kC5 * x[1] - kC1 * x[3] + kC7 * x[5] + kC3 * x[7];
  const Four d3 = kC7 * x[1] - kC5 * x[3] + kC3 * x[5] - kC1 * x[7];
  x[0] = s0 + d0;
  x[7] = s0 - d0;
  x[1] = s1 + d1;
  x[6] = s1 - d1;
  x[2] = s2 + d2;
  x[5] = s2 - d2;
  x[3] = s3 + d3;
  x[4] = s3 - d3;
}

// Biorthogonal spline wavelet 1.5 of eight values, three levels, periodic; rows of unit norm.
inline constexpr float kA = 0.35355339059327379F, kB = 0.21941764925250140F, kC = 0.44928375799321650F;
inline constexpr float kD = 0.56935939834284200F, kE = 0.40234730816227800F, kG = 0.08350604509028400F;
inline constexpr float kH = 0.70710678118654752F;
// Its inverse.
inline constexpr float kQ = 0.37385894106267F, kR = 0.51455855625235F, kT = 0.12153397801644F;

inline void forward_wavelet(Four (&x)[8]) {
  const Four p0 = x[0] + x[1], p1 = x[2] + x[3], p2 = x[4] + x[5], p3 = x[6] + x[7];
  const Four m0 = x[0] - x[1], m1 = x[2] - x[3], m2 = x[4] - x[5], m3 = x[6] - x[7];
  const Four low1 = kB * (x[0] + x[3] - x[4] - x[7]) + kC * (x[1] + x[2] - x[5] - x[6]);
  const Four low2 = kD * (x[0] - x[3]) + kE * (x[1] - x[2]) - kG * (m2 + m3);
  const Four low3 = kD * (x[4] - x[7]) + kE * (x[5] - x[6]) - kG * (m0 + m1);
  x[0] = kA * (p0 + p1 + p2 + p3);
  x[1] = low1;
  x[2] = low2;
  x[3] = low3;
  x[4] = kH * m0;
  x[5] = kH * m1;
  x[6] = kH * m2;
  x[7] = kH * m3;
}

inline void backward_wavelet(Four (&x)[8]) {
  const Four up = kA * x[0] + kQ * x[1], down = kA * x[0] - kQ * x[1];
  const Four even = kT * (x[4] - x[6]), odd = kT * (x[5] - x[7]);
  const Four p0 = up + kR * x[2] - odd, p1 = up - kR * x[2] + even;
  const Four p2 = down + kR * x[3] + odd, p3 = down - kR * x[3] - even;
  const Four m0 = kH * x[4], m1 = kH * x[5], m2 = kH * x[6], m3 = kH * x[7];
  x[0] = p0 + m0;
  x[1] = p0 - m0;
  x[2] = p1 + m1;
  x[3] = p1 - m1;
  x[4] = p2 + m2;
  x[5] = p2 - m2;
  x[6] = p3 + m3;
  x[7] = p3 - m3;
}

// Four rows of four, as columns.
inline void turn(Four& a, Four& b, Four& c, Four& d) {
  const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

// Left and right half of a block: transposed.
inline void turn(Four (&left)[8], Four (&right)[8]) {
  turn(left[0], left[1], left[2], left[3]);
  turn(right[4], right[5], right[6], right[7]);
  turn(left[4], left[5], left[6], left[7]);
  turn(right[0], right[1], right[2], right[3]);
  for (std::size_t k = 0; k < 4; ++k) {
    const Four held = left[4 + k];
    left[4 + k] = right[k];
    right[k] = held;
  }
}

}  // namespace transform

/// The two-dimensional transforms of BM3D's two steps: a wavelet for the first, the orthonormal DCT-II for the second.
enum class BlockTransform { kWavelet, kCosine };

/// Transform of the 8 x 8 values at `in`, rows `stride` apart. The 64 coefficients are transposed (horizontal frequency
/// by rows), the mean's first, as inverse_transform() expects them.
template <BlockTransform kind>
inline void forward_transform(const float* in, std::ptrdiff_t stride, float* coefficients) {
  using namespace transform;
  constexpr auto kOne = kind == BlockTransform::kCosine ? forward_cosine : forward_wavelet;
  Four left[8], right[8];
  for (std::size_t k = 0; k < 8; ++k) {
    left[k] = load(in + static_cast<std::ptrdiff_t>(k) * stride);
    right[k] = load(in + static_cast<std::ptrdiff_t>(k) * stride + 4);
  }
  kOne(left);
  kOne(right);
  turn(left, right);
  kOne(left);
  kOne(right);
  for (std::size_t k = 0; k < 8; ++k) {
    store(left[k], coefficients + 8 * k);
    store(right[k], coefficients + 8 * k + 4);
  }
}

/// In place: coefficients to 8 x 8 values, row by row.
template <BlockTransform kind>
inline void inverse_transform(float* block) {
  using namespace transform;
  constexpr auto kOne = kind == BlockTransform::kCosine ? backward_cosine : backward_wavelet;
  Four left[8], right[8];
  for (std::size_t k = 0; k < 8; ++k) {
    left[k] = load(block + 8 * k);
    right[k] = load(block + 8 * k + 4);
  }
  kOne(left);
  kOne(right);
  turn(left, right);
  kOne(left);
  kOne(right);
  for (std::size_t k = 0; k < 8; ++k) {
    store(left[k], block + 8 * k);
    store(right[k], block + 8 * k + 4);
  }
}

/// Hadamard transform across `count` blocks (a power of two), one after another; not normalised: twice gives count
/// times the blocks.
inline void hadamard(float* blocks, std::size_t count) {
  for (std::size_t half = 1; half < count; half *= 2) {
    for (std::size_t first = 0; first < count; first += 2 * half) {
      float* a = blocks + first * kBlockPixels;
      float* b = a + half * kBlockPixels;
      for (std::size_t k = 0; k < half * kBlockPixels; ++k) {
        const float sum = a[k] + b[k], difference = a[k] - b[k];
        a[k] = sum;
        b[k] = difference;
      }
    }
  }
}

}  // namespace pharos::enhance
