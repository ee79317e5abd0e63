// SPDX-License-Identifier: Apache-2.0
// No halo at the rim of a target that is rendered in low light and enhanced: no glow around it, almost no edging
// inside.
#include "tools/evaluation/low_light/rim_halo.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "host/vision/enhance/enhancer.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::enhance {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::int32_t kWidth = 480, kHeight = 360;

host::GreyImage rendered(double ambient, unsigned seed) {
  const sim::TumblingScenario scenario{
      .good_light = false, .ambient = ambient, .width_px = kWidth, .height_px = kHeight, .stars = 0, .povray = false};
  return sim::TumblingSequence(scenario, seed).image(90, 0);
}

ImageView<const std::uint8_t> view(const Bytes& image) { return {image.data(), kWidth, kHeight}; }

tools::RimHalo halo_of(double ambient, unsigned seed, const host::GreyImage& even) {
  EnhanceSettings settings;
  settings.denoiser = Denoiser::kFast;
  Enhancer enhancer(settings);
  const host::GreyImage dark = rendered(ambient, seed);
  Bytes out(dark.pixels.size());
  to_integers(enhancer.enhance(dark.view()).result.view(), ImageView<std::uint8_t>(out.data(), kWidth, kHeight));
  return tools::rim_halo(view(out), even.view());
}

// In low light the illumination of (5) decreases towards the rim over tens of pixels, and R increases as much: 23 of
// 255 at ambient 0.1 (a multi-scale retinex: see `pharos bench enhance`). At ambient 0.01 one draw of the noise gives
// 5 to 9 of 255 (seeds 3 to 9: mean 7.0, standard deviation 1.5), so the mean of four is tested, with three of its
// standard deviations.
TEST(RimHalo, AnEnhancedTargetHasNoneAroundAndLittleInside) {
  constexpr unsigned kSeeds = 4;
  for (const auto& [ambient, edging] : {std::pair{0.1, 25.5}, {0.01, 9.2}}) {
    double inside = 0.0;
    for (unsigned seed = 3; seed < 3 + kSeeds; ++seed) {
      const tools::RimHalo halo = halo_of(ambient, seed, rendered(0.8, seed));
      EXPECT_NEAR(255.0 * halo.outside, 0.0, 0.5) << ambient;
      inside += 255.0 * halo.inside / kSeeds;
    }
    EXPECT_NEAR(inside, 0.0, edging) << ambient;
  }
}

// The measure itself, on a uniform square: it finds painted halos.
TEST(RimHalo, DetectsAGlowAndARim) {
  host::GreyImage even{kWidth, kHeight, 16, std::vector<std::uint16_t>(kWidth * kHeight, 0)};
  Bytes plain(even.pixels.size(), 4), glowing = plain, edged = plain;
  for (std::int32_t v = 0; v < kHeight; ++v) {
    for (std::int32_t u = 0; u < kWidth; ++u) {
      const int outside = std::max({100 - u, u - 299, 80 - v, v - 279});  // px, from 1 on; inside 0 and below
      const auto k = static_cast<std::size_t>(v * kWidth + u);
      even.pixels[k] = outside > 0 ? 0 : 40000;
      for (Bytes* image : {&plain, &glowing, &edged}) (*image)[k] = outside > 0 ? 4 : 150;
      if (outside > 0 && outside <= 6) glowing[k] = 24;
      if (outside <= 0 && outside > -5) edged[k] = 135;
    }
  }
  EXPECT_NEAR(tools::rim_halo(view(plain), even.view()).outside, 0.0, 1e-9);
  EXPECT_NEAR(tools::rim_halo(view(plain), even.view()).inside, 0.0, 1e-9);
  EXPECT_NEAR(255.0 * tools::rim_halo(view(glowing), even.view()).outside, 20.0, 1e-9);
  EXPECT_NEAR(255.0 * tools::rim_halo(view(glowing), even.view()).inside, 0.0, 1e-9);
  EXPECT_NEAR(255.0 * tools::rim_halo(view(edged), even.view()).inside, -15.0, 1e-9);
}

}  // namespace
}  // namespace pharos::enhance
