// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/patch.hpp"

#include <gtest/gtest.h>

#include "simulated_wall.hpp"

namespace pharos::slam {
namespace {

using namespace test;

class PatchOfAWall : public ::testing::Test {
 protected:
  // Error of the aligned position for a start that is `off`, with the wall at `later`; negative: not aligned.
  double error_px(const Wall& later, double turn_rad, const Vector2& off) const {
    const CameraFromTarget there = turned_pose(turn_rad);
    const auto image = later.seen(there);
    const Vector2 truth = kCamera.project(there * wall_.hit(here_, pixel_)).head<2>();
    Feature feature;
    feature.pixel = truth + off;
    const auto patch = cut_patch(0, wall_.feature(here_, pixel_), pyramid_of(first_));
    const auto found = find_patch(*patch, there * here_.inverse(), kCamera, feature, pyramid_of(image));
    return found ? (found->pixel - truth).norm() : -1.0;
  }
  Wall wall_;
  CameraFromTarget here_ = turned_pose(0.0);
  Vector2 pixel_{300.3, 220.6};
  std::vector<std::uint8_t> first_ = wall_.seen(here_);
};

TEST_F(PatchOfAWall, IsFoundToAFewHundredthsOfAPixelFromWhereverItIsSeen) {
  for (const double turn : {0.0, 0.1, 0.3, -0.3}) {
    const double error = error_px(wall_, turn, {0.6, -0.5});
    EXPECT_GE(error, 0.0) << turn;
    EXPECT_LT(error, 0.05) << turn;
  }
}

TEST_F(PatchOfAWall, OtherLightIsTheSamePatch) {
  Wall later = wall_;
  later.contrast = 35.0;
  later.brightness = 90.0;
  const double error = error_px(later, 0.1, {-0.4, 0.4});
  EXPECT_GE(error, 0.0);
  EXPECT_LT(error, 0.05);
}

TEST_F(PatchOfAWall, LightThatRisesAcrossItDoesNotMoveIt) {
  Wall later = wall_;
  later.contrast = 25.0;
  later.light_slope = {0.8, -0.7};
  const double error = error_px(later, 0.1, {-0.4, 0.4});
  EXPECT_GE(error, 0.0);
  EXPECT_LT(error, 0.05);
}

TEST_F(PatchOfAWall, WhatIsElsewhereAslantOrUnlikeIsNotFound) {
  EXPECT_LT(error_px(wall_, 0.1, {2.5, 2.5}), 0.0);
  EXPECT_LT(error_px(wall_, 1.25, {0.0, 0.0}), 0.0);
  Wall other = wall_;
  other.contrast = -50.0;
  EXPECT_LT(error_px(other, 0.1, {0.0, 0.0}), 0.0);
  other.contrast = 0.0;
  EXPECT_LT(error_px(other, 0.1, {0.0, 0.0}), 0.0);
}

TEST_F(PatchOfAWall, IsNotCutAtTheBorderNorWithoutADepth) {
  EXPECT_FALSE(cut_patch(0, wall_.feature(here_, {5.0, 200.0}), pyramid_of(first_)));
  Feature mono;
  mono.pixel = {200.0, 200.0};
  EXPECT_FALSE(cut_patch(0, mono, pyramid_of(first_)));
  EXPECT_FALSE(cut_patch(0, wall_.feature(here_, pixel_), {}));
}

}  // namespace
}  // namespace pharos::slam
