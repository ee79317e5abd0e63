// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/luma.hpp"

#include <algorithm>

namespace pharos::enhance {

double LumaDenoiser::denoise(const FloatImage& reflectance, const EnhanceSettings& settings, FloatImage& denoised) {
  denoised.shape(reflectance.width_px, reflectance.height_px, reflectance.channels);
  std::transform(reflectance.values.begin(), reflectance.values.end(), denoised.values.begin(),
                 [](float value) { return std::min(value, 1.0F); });
  if (settings.denoiser == Denoiser::kNone) return 0.0;
  return 0.0;
}

}  // namespace pharos::enhance
