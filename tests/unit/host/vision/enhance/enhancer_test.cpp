// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/enhancer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/vision/enhance/luma.hpp"
#include "host/vision/enhance/smoothness.hpp"
#include "tools/evaluation/bench/exact_illumination.hpp"
#include "unit/host/vision/enhance/test_images.hpp"

namespace pharos::enhance {
namespace {

EnhanceSettings with(Denoiser denoiser) {
  EnhanceSettings settings;
  settings.denoiser = denoiser;
  return settings;
}

FloatImage coloured(float red, float green, float blue) {
  const FloatImage grey = test::painted_target(96, 64, 0.2F);
  FloatImage colour;
  colour.shape(96, 64, 3);
  const float tints[3] = {red, green, blue};
  for (int c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < grey.pixels(); ++k) colour.plane(c)[k] = tints[c] * grey.values[k];
  }
  return colour;
}

TEST(Enhancer, StepsAreThoseOfThePaper) {
  FloatImage frame = coloured(1.0F, 0.6F, 0.3F);
  test::add_noise(frame, 0.002, 9);
  for (float& value : frame.values) value = std::max(value, 0.0F);
  Enhancer enhancer(with(Denoiser::kBm3d));
  const Enhanced& steps = enhancer.enhance(frame);
  ASSERT_EQ(steps.result.channels, 3);
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    const float light = steps.illumination.values[k];
    ASSERT_NEAR(light, std::pow(steps.refined.values[k], 0.8F), 1e-6F);
    float maximum = 0.0F;
    for (int c = 0; c < 3; ++c) {
      const float value = frame.plane(c)[k];
      maximum = std::max(maximum, value);
      ASSERT_NEAR(steps.reflectance.plane(c)[k] * light, value, 2e-3F * value + 1e-6F);  // (1)
      const float plain = std::min(steps.reflectance.plane(c)[k] / steps.peak, 1.0F);
      ASSERT_NEAR(steps.result.plane(c)[k], plain * light + steps.denoised.plane(c)[k] * (1.0F - light), 1e-5F);  // (8)
    }
    ASSERT_EQ(steps.start.values[k], maximum);  // (2)
  }
}

// The defaults are strategy III with alpha 0.15 and sigma 2; half or twice of either gives another result.
TEST(Enhancer, DefaultsAreThoseOfThePaper) {
  const FloatImage frame = test::painted_target(96, 64, 0.2F);
  const auto off = [&](double alpha, double sigma_px) {
    SmoothnessSystem system;
    SmoothnessWeights().weigh(frame, WeightStrategy::kWindow, alpha, sigma_px, system);
    Enhancer enhancer;
    return tools::rms_of_range(enhancer.illuminate(frame).refined, tools::exact_illumination(system, frame));
  };
  const double ours = off(0.15, 2.0);
  EXPECT_LT(ours, 5e-3);
  for (const auto& [alpha, sigma_px] : {std::pair{0.3, 2.0}, {0.075, 2.0}, {0.15, 4.0}, {0.15, 1.0}}) {
    EXPECT_GT(off(alpha, sigma_px), 2.0 * ours) << alpha << ' ' << sigma_px;
  }
}

// Y of YCbCr by the weights of ITU-R BT.601.
TEST(Luma, IsThatOfTheStandard) {
  FloatImage colours, luma;
  colours.shape(3, 1, 3);
  std::fill(colours.values.begin(), colours.values.end(), 0.0F);
  for (int c = 0; c < 3; ++c) colours.plane(c)[c] = 1.0F;
  luma_of(colours, luma);
  ASSERT_EQ(luma.values.size(), 3U);
  EXPECT_NEAR(luma.values[0], 0.299F, 1e-6F);
  EXPECT_NEAR(luma.values[1], 0.587F, 1e-6F);
  EXPECT_NEAR(luma.values[2], 0.114F, 1e-6F);
}

// Only Y is denoised: a pixel's change is the same in red, green and blue, wherever nothing is clipped.
TEST(Luma, DenoisedColoursKeepTheirTint) {
  FloatImage frame = coloured(3.0F, 2.0F, 1.5F);
  for (float& value : frame.values) value += 0.1F;
  test::add_noise(frame, 0.02, 4);
  LumaDenoiser denoiser;
  FloatImage quiet;
  EXPECT_GT(denoiser.denoise(frame, 1.0F, with(Denoiser::kBm3d), quiet), 0.01);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    const float red = quiet.plane(0)[k] - frame.plane(0)[k];
    bool cut = false;
    for (int c = 0; c < 3; ++c)
      cut = cut || quiet.plane(c)[k] <= 0.0F || quiet.plane(c)[k] >= 1.0F || frame.plane(c)[k] <= 0.0F ||
            frame.plane(c)[k] >= 1.0F;
    if (cut) continue;
    for (int c = 1; c < 3; ++c) ASSERT_NEAR(quiet.plane(c)[k] - frame.plane(c)[k], red, 1e-5F) << k;
    changed += std::abs(red) > 0.005F ? 1U : 0U;
  }
  EXPECT_GT(changed, frame.pixels() / 4);
}

TEST(Enhancer, DarkTargetBecomesBrightAndBlackStaysBlack) {
  const FloatImage frame = test::painted_target(160, 120, 0.05F);
  Enhancer enhancer(with(Denoiser::kNone));
  const Enhanced& steps = enhancer.enhance(frame);
  double target = 0.0, before = 0.0;
  for (std::size_t k = 0; k < frame.pixels(); ++k) {
    if (frame.values[k] == 0.0F) {
      ASSERT_EQ(steps.result.values[k], 0.0F);
    }
    target += static_cast<double>(steps.result.values[k]);
    before += static_cast<double>(frame.values[k]);
  }
  EXPECT_GT(target, 8.0 * before);
}

// A chequered square in the dark, with a little noise: the background near its rim must equal that far away, and its
// fields near the rim those at its centre.
TEST(Enhancer, TargetsRimHasNoHalo) {
  for (const float light : {0.5F, 0.08F, 0.02F}) {
    FloatImage frame;
    frame.shape(320, 240, 1);
    for (std::int32_t v = 60; v < 180; ++v) {
      for (std::int32_t u = 80; u < 240; ++u) frame.view().at(u, v) = (u / 8 + v / 8) % 2 == 0 ? light : 0.75F * light;
    }
    test::add_noise(frame, 0.0006, 3);
    for (float& value : frame.values) value = std::max(value, 0.0F);
    Enhancer enhancer(with(Denoiser::kFast));
    const Enhanced& steps = enhancer.enhance(frame);
    const auto band = [&](int low, int high) {  // distance outside the square, px
      double sum = 0.0;
      int count = 0;
      for (std::int32_t v = 0; v < 240; ++v) {
        for (std::int32_t u = 0; u < 320; ++u) {
          const int outside = std::max({80 - u, u - 239, 60 - v, v - 179});
          if (outside < low || outside > high) continue;
          sum += static_cast<double>(steps.result.view().at(u, v));
          ++count;
        }
      }
      return sum / count;
    };
    EXPECT_NEAR(band(2, 10), band(30, 60), 2.0 / 255.0) << light;
    EXPECT_NEAR(band(-15, -2), band(-50, -30), 0.1) << light;
    EXPECT_GT(band(-50, -30), 0.5) << light;
    EXPECT_LT(band(-50, -30), 0.99) << light;  // not all white
  }
}

TEST(Enhancer, GreyInIsGreyOut) {
  const FloatImage grey = test::painted_target(96, 64, 0.2F);
  FloatImage colour;
  colour.shape(96, 64, 3);
  for (int c = 0; c < 3; ++c) std::copy(grey.values.begin(), grey.values.end(), colour.plane(c));
  Enhancer of_grey(with(Denoiser::kFast)), of_colour(with(Denoiser::kFast));
  const FloatImage from_grey = of_grey.enhance(grey).result;
  const FloatImage from_colour = of_colour.enhance(colour).result;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < grey.pixels(); ++k) {
      ASSERT_EQ(from_colour.plane(c)[k], from_colour.plane(0)[k]);
      ASSERT_NEAR(from_colour.plane(c)[k], from_grey.values[k], 1e-4F);
    }
  }
}

TEST(Enhancer, EightAndSixteenBitsOfOneImageAgree) {
  FloatImage frame = test::painted_target(96, 64, 0.3F);
  test::round_to_8_bits(frame);
  std::vector<std::uint8_t> narrow(frame.pixels());
  std::vector<std::uint16_t> wide(frame.pixels());
  const FloatImage& read_only = frame;
  to_integers(read_only.view(), ImageView<std::uint8_t>(narrow.data(), 96, 64));
  to_integers(read_only.view(), ImageView<std::uint16_t>(wide.data(), 96, 64));
  Enhancer of_narrow, of_wide;
  const FloatImage a = of_narrow.enhance(ImageView<const std::uint8_t>(narrow.data(), 96, 64)).result;
  const FloatImage b = of_wide.enhance(ImageView<const std::uint16_t>(wide.data(), 96, 64)).result;
  EXPECT_LT(test::rms_difference(a, b), 1e-4);
}

TEST(Enhancer, WarmFramesEndWhereColdOnesDo) {
  Enhancer warm(with(Denoiser::kNone)), cold(with(Denoiser::kNone));
  FloatImage frame = test::painted_target(200, 150, 0.1F);
  const int first = warm.enhance(frame).iterations;
  for (float& value : frame.values) value *= 1.02F;
  const Enhanced& again = warm.enhance(frame);
  EXPECT_LT(again.iterations, first);
  EXPECT_LT(test::rms_difference(again.result, cold.enhance(frame).result), 5e-3);
}

TEST(Enhancer, ForgottenFramesLeaveNoTrace) {
  const FloatImage before = test::painted_target(96, 64, 0.5F), frame = test::painted_target(96, 64, 0.1F);
  Enhancer used(with(Denoiser::kFast)), fresh(with(Denoiser::kFast));
  used.enhance(before);
  used.forget();
  EXPECT_EQ(used.enhance(frame).result.values, fresh.enhance(frame).result.values);
}

TEST(Enhancer, FramesMayChangeTheirSize) {
  Enhancer enhancer;
  for (const auto& [width, height] : {std::pair{96, 64}, {20, 100}, {1, 1}, {3, 200}, {96, 64}}) {
    const Enhanced& steps = enhancer.enhance(test::painted_target(width, height, 0.2F));
    EXPECT_EQ(steps.result.width_px, width);
    for (const float value : steps.result.values) ASSERT_TRUE(value >= 0.0F && value <= 1.0F);
  }
  EXPECT_EQ(enhancer.enhance(ImageView<const std::uint8_t>()).result.pixels(), 0U);
}

TEST(Enhancer, BlackAndWhiteFramesStay) {
  FloatImage frame;
  frame.shape(64, 48, 1);
  std::fill(frame.values.begin(), frame.values.end(), 0.0F);
  Enhancer enhancer;
  for (const float value : enhancer.enhance(frame).result.values) ASSERT_EQ(value, 0.0F);
  std::fill(frame.values.begin(), frame.values.end(), 1.0F);
  for (const float value : enhancer.enhance(frame).result.values) ASSERT_NEAR(value, 1.0F, 1e-3F);
}

}  // namespace
}  // namespace pharos::enhance
