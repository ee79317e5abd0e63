// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "host/vision/enhance/float_image.hpp"

namespace pharos::enhance {

/// Search parameters of BM3D. The defaults are the "normal profile" of the literature.
struct Bm3dSettings {
  std::int32_t hard_step_px = 3;    ///< from one reference block to the next, first step; 1 to 8
  std::int32_t wiener_step_px = 3;  ///< second step; 1 to 8
  std::int32_t reach_px = 19;       ///< of the search for similar blocks, to each side; 1 to 28
  std::size_t hard_blocks = 16;     ///< most in a stack, a power of two up to 16
  std::size_t wiener_blocks = 16;
};

/// A fifth of the time, 0.2 dB less.
inline constexpr Bm3dSettings kVideoBm3d{6, 5, 8, 8, 16};

/// Image denoising by sparse 3-D transform-domain collaborative filtering (BM3D; Dabov, Foi, Katkovnik, Egiazarian,
/// IEEE Trans. Image Processing 16, 2007), both steps: similar blocks are stacked, transformed (2-D, then
/// Hadamard across the stack) and shrunk by a hard threshold; then again, matched on the first result, by the Wiener
/// filter computed from it. Blocks of 8 x 8, wavelet 1.5 in the first step and DCT in the second, aggregated with
/// Kaiser's window.
///
/// Reuses its buffers. The result is identical, bit by bit, for any number of threads. 640x480 on one core: some 0.5 s
/// (kVideoBm3d 0.1 s); thresholds() 8 ms.
class BlockDenoiser {
 public:
  BlockDenoiser();
  BlockDenoiser(BlockDenoiser&&) noexcept;
  BlockDenoiser& operator=(BlockDenoiser&&) noexcept;
  ~BlockDenoiser();

  /// `noisy` with white noise of the standard deviation `sigma` (1 = white) in `out`, both of one plane. An image
  /// smaller than a block, or one with a sigma of 0, is copied.
  void bm3d(const FloatImage& noisy, double sigma, const Bm3dSettings& settings, int threads, FloatImage& out);

  /// The hard threshold on single overlapping blocks under the DCT: no matching, no second step.
  void thresholds(const FloatImage& noisy, double sigma, int threads, FloatImage& out);

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace pharos::enhance
