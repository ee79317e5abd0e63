// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/enhance/enhancer.hpp"

namespace pharos::enhance {

/// R_d of R: cut to 0 ... 1, and its luma denoised (colour differences Cb and Cr stay as they are, so that every
/// channel moves by what the luma moves). Keeps its memory.
class LumaDenoiser {
 public:
  /// Returns the standard deviation of the noise that it worked with; 0 without a denoiser.
  double denoise(const FloatImage& reflectance, const EnhanceSettings& settings, FloatImage& denoised);

 private:
  FloatImage luma_, quiet_;
};

}  // namespace pharos::enhance
