// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/enhance/bm3d.hpp"
#include "host/vision/enhance/enhancer.hpp"

namespace pharos::enhance {

/// Y of YCbCr (ITU-R BT.601, full range); of a grey image its only plane.
void luma_of(const FloatImage& image, FloatImage& luma);

/// Divides an image by `white`, clips it to 0 ... 1 and denoises its luma; Cb and Cr are unchanged. Reuses its buffers.
class LumaDenoiser {
 public:
  /// Returns the standard deviation of the noise that was used, given or estimated; 0 without a denoiser.
  double denoise(const FloatImage& image, float white, const EnhanceSettings& settings, FloatImage& denoised);

 private:
  BlockDenoiser blocks_;
  FloatImage luma_, quiet_;
};

}  // namespace pharos::enhance
