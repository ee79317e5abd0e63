// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/blur.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pharos::sim {
namespace {

double variance_of(const Kernel& kernel) {
  double sum = 0.0;
  for (std::size_t i = 1; i < kernel.size(); ++i)
    sum += 2.0 * static_cast<double>(kernel[i] * static_cast<float>(i * i));
  return sum;
}

TEST(Blur, KernelsHoldTheWholeWeightAndTheVarianceThatWasAskedFor) {
  for (const double sigma : {0.8, 1.5, 3.0}) {
    const Kernel over = gaussian_over_pixels(sigma), at = gaussian_at_pixels(sigma);
    for (const Kernel& kernel : {over, at}) {
      float total = kernel[0];
      for (std::size_t i = 1; i < kernel.size(); ++i) total += 2.0F * kernel[i];
      EXPECT_NEAR(total, 1.0F, 1e-6F);
    }
    EXPECT_NEAR(variance_of(over), sigma * sigma + 1.0 / 12.0, 0.003 * sigma * sigma);  // with the pixel's own width
    EXPECT_NEAR(variance_of(at), sigma * sigma, 0.003 * sigma * sigma);
  }
}

TEST(Blur, KeepsLightAndSpreadsItAsAsked) {
  LinearImage image{41, 31, std::vector<float>(41 * 31, 0.0F)};
  image.at(20, 15) = 1.0F;
  const LinearImage soft = blurred(image, 1.5);
  double total = 0.0, across = 0.0, down = 0.0;
  for (std::int32_t v = 0; v < 31; ++v) {
    for (std::int32_t u = 0; u < 41; ++u) {
      const auto light = static_cast<double>(soft.at(u, v));
      total += light;
      across += light * (u - 20) * (u - 20);
      down += light * (v - 15) * (v - 15);
    }
  }
  EXPECT_NEAR(total, 1.0, 1e-5);
  EXPECT_NEAR(across, 1.5 * 1.5 + 1.0 / 12.0, 0.01);
  EXPECT_NEAR(down, 1.5 * 1.5 + 1.0 / 12.0, 0.01);
}

TEST(Blur, AnEvenImageStaysEvenUpToItsBorder) {
  const LinearImage soft = blurred({20, 10, std::vector<float>(200, 0.4F)}, 2.0);
  for (const float light : soft.light) EXPECT_NEAR(light, 0.4F, 1e-6F);
}

TEST(Blur, OfZeroLeavesTheImageAlone) {
  const LinearImage image{3, 1, {0.1F, 0.9F, 0.3F}};
  EXPECT_EQ(blurred(image, 0.0).light, image.light);
}

TEST(Blur, SmallImagesAreBlurredToo) {
  const LinearImage soft = blurred({1, 2, {1.0F, 0.0F}}, 1.0);
  EXPECT_NEAR(soft.light[0] + soft.light[1], 1.0F, 1e-6F);
  EXPECT_GT(soft.light[0], soft.light[1]);
}

TEST(Blur, VarianceRatioIsWhatAPulsesSquaresSumTo) {
  std::vector<float> pulse(31 * 31);
  pulse[15 * 31 + 15] = 1.0F;
  const Kernel kernel = gaussian_at_pixels(0.75);
  convolve(pulse, 31, 31, kernel);
  double squares = 0.0;
  for (const float value : pulse) squares += static_cast<double>(value) * static_cast<double>(value);
  EXPECT_NEAR(variance_ratio(kernel), squares, 1e-7);
}

}  // namespace
}  // namespace pharos::sim
