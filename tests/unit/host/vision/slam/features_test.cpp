// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "host/vision/slam/foreground.hpp"
#include "host/vision/slam/quadtree.hpp"
#include "host/vision/slam/stereo_frontend.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::slam {
namespace {

std::vector<std::uint8_t> eight_bits(const host::GreyImage& image) {
  std::vector<std::uint8_t> out;
  for (const std::uint16_t value : image.pixels) out.push_back(static_cast<std::uint8_t>(value >> 8U));
  return out;
}

TEST(Quadtree, SpreadsAndKeepsTheStrongest) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> fraction(0.0F, 1.0F);
  std::vector<Corner> corners{{5.0F, 5.0F, 1000.0F}};
  for (int k = 0; k < 3000; ++k)
    corners.push_back({300.0F + 30.0F * fraction(random), 200.0F + 30.0F * fraction(random), 50.0F});
  for (int k = 0; k < 200; ++k) corners.push_back({640.0F * fraction(random), 480.0F * fraction(random), 10.0F});
  const auto kept = spread(corners, 640.0F, 480.0F, 100);
  EXPECT_NEAR(static_cast<double>(kept.size()), 100.0, 5.0);
  const auto crowded = std::count_if(kept.begin(), kept.end(), [](const Corner& k) { return k.response == 50.0F; });
  EXPECT_LT(crowded, 50);
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [](const Corner& k) { return k.response == 1000.0F; }));
  EXPECT_EQ(spread(kept, 640.0F, 480.0F, 1000).size(), kept.size());
}

class Turning : public ::testing::Test {
 protected:
  Turning() : sequence_({.turn_deg = 10.0, .stars = 200, .povray = false}, 3) {}
  sim::TumblingSequence sequence_;
};

TEST_F(Turning, DepthsOfFeaturesAreThoseOfTheFaces) {
  SlamSettings settings;
  StereoFrontend frontend(rectify(sequence_.rig(), "rig"), settings);
  const auto left_image = sequence_.image(0, 0), right_image = sequence_.image(0, 1);
  const auto left = eight_bits(left_image), right = eight_bits(right_image);
  const auto result = frontend.push({left.data(), 640, 480}, {right.data(), 640, 480}, false);
  EXPECT_GT(result.features.size(), 800U);
  EXPECT_GT(result.stats.matched, 500);
  // Distance from the nearest plane of the satellite, as disparity.
  const auto T_camera_target = sequence_.rig().left.pose().inverse() * sequence_.pose(0);
  std::vector<double> errors;  // in sigmas of a coordinate
  for (const Feature& feature : result.features) {
    if (!feature.stereo()) continue;
    const StereoCamera& camera = frontend.camera();
    const Vector3 ray = camera.back_project(feature.pixel, 1.0);
    double nearest = 1e9;
    for (const auto& [axis, offset] :
         {std::pair{0, -0.7}, {0, 0.7}, {1, -0.7}, {1, 0.7}, {2, -0.8}, {2, 0.8}, {1, 0.0}}) {
      const Vector3 normal = T_camera_target.R.col(axis);
      const double depth = (offset + normal.dot(T_camera_target.t)) / normal.dot(ray);
      const double disparity = camera.fx_px * camera.baseline_m / depth;
      nearest = std::min(nearest, std::abs(disparity - (feature.pixel.x() - feature.right_u_px)));
    }
    errors.push_back(nearest / std::sqrt(feature.variance_px2()));
  }
  std::sort(errors.begin(), errors.end());
  // A disparity is the difference of two coordinates: Gaussian ones would have their median at 0.95.
  EXPECT_LT(errors[errors.size() / 2], 0.95);
  EXPECT_LT(errors[errors.size() * 9 / 10], 3.0);
}

TEST_F(Turning, NoFeatureIsAStar) {
  SlamSettings settings;
  StereoFrontend frontend(rectify(sequence_.rig(), "rig"), settings);
  const auto left_image = sequence_.image(0, 0), right_image = sequence_.image(0, 1);
  const auto left = eight_bits(left_image), right = eight_bits(right_image);
  const auto result = frontend.push({left.data(), 640, 480}, {right.data(), 640, 480}, false);
  // 3.8 m at 5 m with 640 px, seen 0.25 m from the side: no part of the body is higher or lower than this.
  for (const Feature& feature : result.features) {
    EXPECT_GT(feature.pixel.y(), 60.0);
    EXPECT_LT(feature.pixel.y(), 420.0);
  }
}

TEST(StaticFeatureFilter, AreRemovedWhileTheBodyMovesAndKeptWhenAllIsStatic) {
  std::mt19937_64 random(1);
  std::vector<Feature> still(20), moving(60);
  for (auto* group : {&still, &moving}) {
    for (Feature& feature : *group) {
      feature.pixel = {static_cast<double>(random() % 600), static_cast<double>(random() % 400)};
      feature.descriptor.bits = {random(), random(), random(), random()};
    }
  }
  StaticFeatureFilter filter, resting;
  std::vector<Feature> seen, all_rest;
  for (int frame = 0; frame < 15; ++frame) {
    seen = still;
    for (Feature& feature : moving) {
      feature.pixel.x() += 2.0;
      seen.push_back(feature);
    }
    filter.remove_static(seen);
    all_rest = still;
    resting.remove_static(all_rest);
  }
  EXPECT_EQ(filter.removed(), 20);
  EXPECT_EQ(seen.size(), 60U);
  EXPECT_EQ(all_rest.size(), 20U);
}

}  // namespace
}  // namespace pharos::slam
