// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pharos/tof/image_profile.hpp"
#include "pharos/tof/layer_intensity.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

constexpr int kSearch_px = 4;
constexpr int kMiddle = kSearch_px + kProfileReach_px;

// A step of 1000 counts at `edge_px` from the middle, blurred by a Gaussian of 0.8 px.
std::array<double, kMaxSamples> step_at(double edge_px) {
  std::array<double, kMaxSamples> profile{};
  for (int k = 0; k <= 2 * kMiddle; ++k) {
    profile[static_cast<std::size_t>(k)] =
        500.0 * (1.0 + std::erf((k - kMiddle - edge_px) / (0.8 * std::numbers::sqrt2)));
  }
  return profile;
}

TEST(SteepestOfSamples, IsWhereTheStepIsToAFractionOfAPixel) {
  for (double edge_px = -2.4; edge_px < 2.5; edge_px += 0.3) {
    const ProfileEdge edge = steepest_of_samples(step_at(edge_px), kSearch_px, 1.0);
    EXPECT_NEAR(edge.offset_px, edge_px, 0.03);
    EXPECT_GT(edge.strength, 200.0);
  }
}

TEST(SteepestOfSamples, IsNoneForTheOtherSignAndWhereTheChangeStillGrows) {
  EXPECT_EQ(steepest_of_samples(step_at(0.0), kSearch_px, -1.0).strength, 0.0);
  EXPECT_EQ(steepest_of_samples(step_at(kSearch_px + 1.5), kSearch_px, 1.0).strength, 0.0);
  EXPECT_EQ(steepest_of_samples({}, kSearch_px, 1.0).strength, 0.0);
}

TEST(LightOfLayer, SeparatesALayerFromABrighterBase) {
  // Left: the base alone, 3000 counts at -0.1 m. Right: the layer, 1000 counts at 0. Between: both by fractions.
  LightProfile profile;
  for (int k = 0; k <= 2 * kMiddle; ++k) {
    const double layer = std::clamp((k - kMiddle) / 2.0 + 0.5, 0.0, 1.0);
    const auto i = static_cast<std::size_t>(k);
    profile.amplitude[i] = layer * 1000.0 + (1.0 - layer) * 3000.0;
    profile.moment[i] = (1.0 - layer) * 3000.0 * -0.1;
  }
  const auto light = light_of_layer(profile, kSearch_px, 0.0, -0.1);
  EXPECT_NEAR(light[0], 0.0, 1e-9);
  EXPECT_NEAR(light[static_cast<std::size_t>(kMiddle)], 500.0, 1e-9);
  EXPECT_NEAR(light[static_cast<std::size_t>(2 * kMiddle)], 1000.0, 1e-9);
}

TEST(WallShift, IsNoneWithoutAWallAndGrowsWithItsBrightness) {
  EXPECT_EQ(wall_shift_px(0.0, 3.0), 0.0);
  EXPECT_GT(wall_shift_px(0.2, 3.0), 0.0);
  EXPECT_GT(wall_shift_px(0.4, 3.0), wall_shift_px(0.2, 3.0));
}

class SampleLightTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rays_->prepare(camera_.intrinsics));
    frame_.width_px = camera_.intrinsics.width_px;
    frame_.height_px = camera_.intrinsics.height_px;
    const auto pixels = static_cast<std::size_t>(frame_.width_px * frame_.height_px);
    frame_.intensity.assign(pixels, 4000);
    frame_.depth.assign(pixels, counts_of(3.0));
  }
  std::size_t at(int u, int v) const { return static_cast<std::size_t>(v * frame_.width_px + u); }
  std::uint16_t counts_of(double z_m) const { return static_cast<std::uint16_t>(z_m / camera_.depth_scale_m + 0.5); }
  void lose_depth(int first_u, int last_u) {
    for (int v = 0; v < frame_.height_px; ++v) {
      for (int u = first_u; u <= last_u; ++u) frame_.depth[at(u, v)] = 0;
    }
  }
  bool sample(const Vector2& middle) {
    return sample_light(frame_.view(), camera_, *rays_, DepthPlane{Vector3::UnitZ() / 3.1}, middle, Vector2::UnitX(),
                        kSearch_px, 400.0, profile_);
  }
  DepthCamera camera_ = test::small_camera();
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  test::SyntheticFrame frame_;
  LightProfile profile_;
};

TEST_F(SampleLightTest, IsAmplitudeTimesHeightOverThePlane) {
  ASSERT_TRUE(sample(Vector2(160.4, 120.7)));
  for (int k = 0; k <= 2 * kMiddle; ++k) {
    EXPECT_NEAR(profile_.amplitude[static_cast<std::size_t>(k)], 4000.0, 1e-6);
    EXPECT_NEAR(profile_.moment[static_cast<std::size_t>(k)], 4000.0 * 0.1, 1.0);
  }
}

TEST_F(SampleLightTest, FailsAtTheBorderAndAtLightWithoutDepth) {
  EXPECT_FALSE(sample(Vector2(3.0, 120.0)));
  lose_depth(161, 170);
  EXPECT_FALSE(sample(Vector2(160.0, 120.0)));
  for (int u = 161; u <= 170; ++u) {  // dark: no light, no depth needed
    frame_.intensity[at(u, 120)] = frame_.intensity[at(u, 121)] = 100;
  }
  EXPECT_TRUE(sample(Vector2(160.0, 120.0)));
}

// Foil as bright as the ring behind its edge, and a camera that gives no depth where two surfaces share a pixel.
TEST_F(SampleLightTest, TheEdgeOfTwoSurfacesOfOneBrightnessIsTheMiddleOfThePixelsWithoutDepth) {
  for (const int width : {1, 2, 3, 4}) {
    SetUp();
    for (int v = 0; v < frame_.height_px; ++v) {
      for (int u = 161; u < frame_.width_px; ++u) frame_.depth[at(u, v)] = counts_of(3.1);
    }
    const int half = width / 2;
    lose_depth(161 - half, 160 - half + width);
    const double edge = 160.5 - half + 0.5 * width, middle = 160.7;
    ASSERT_TRUE(sample(Vector2(middle, 120.0)));
    const auto found = steepest_of_samples(light_of_layer(profile_, kSearch_px, 0.1, 0.0), kSearch_px, -1.0);
    ASSERT_GT(found.strength, 0.0) << width;
    EXPECT_NEAR(middle + found.offset_px, edge, 0.1) << width;
  }
}

}  // namespace
}  // namespace pharos::tof
