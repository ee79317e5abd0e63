// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/luma.hpp"

#include <algorithm>

#include "host/vision/enhance/noise_level.hpp"

namespace pharos::enhance {

void luma_of(const FloatImage& image, FloatImage& luma) {
  luma.shape(image.width_px, image.height_px, 1);
  if (image.channels == 1) {
    luma.values = image.values;
    return;
  }
  constexpr float kRed = 0.299F, kGreen = 0.587F, kBlue = 0.114F;
  const float *red = image.plane(0), *green = image.plane(1), *blue = image.plane(2);
  for (std::size_t k = 0; k < image.pixels(); ++k) {
    luma.values[k] = kRed * red[k] + kGreen * green[k] + kBlue * blue[k];
  }
}

double LumaDenoiser::denoise(const FloatImage& image, float white, const EnhanceSettings& settings,
                             FloatImage& denoised) {
  denoised.shape(image.width_px, image.height_px, image.channels);
  std::transform(image.values.begin(), image.values.end(), denoised.values.begin(),
                 [scale = 1.0F / white](float value) { return std::clamp(value * scale, 0.0F, 1.0F); });
  if (settings.denoiser == Denoiser::kNone) return 0.0;
  luma_of(denoised, luma_);
  const FloatImage& luma = luma_;
  const double sigma = settings.noise_sigma ? *settings.noise_sigma : noise_level(luma.view());
  if (settings.denoiser == Denoiser::kBm3d) {
    blocks_.bm3d(luma, sigma, settings.bm3d, settings.threads, quiet_);
  } else {
    blocks_.thresholds(luma, sigma, settings.threads, quiet_);
  }
  // With unchanged Cb and Cr, all channels change by the same amount as Y.
  for (int c = 0; c < denoised.channels; ++c) {
    float* to = denoised.plane(c);
    for (std::size_t k = 0; k < denoised.pixels(); ++k) {
      to[k] = std::clamp(to[k] + quiet_.values[k] - luma_.values[k], 0.0F, 1.0F);
    }
  }
  return sigma;
}

}  // namespace pharos::enhance
