// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/patch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

// A plane with smoothly varying brightness, seen by kCamera.
struct Wall {
  Vector3 normal{0.3, -0.2, -1.0};  // in the target's frame
  double offset_m = 0.0;
  double contrast = 50.0, brightness = 120.0;

  Vector3 hit(const CameraFromTarget& pose, const Vector2& pixel) const {
    const auto T_target_camera = pose.inverse();
    const Vector3 ray = T_target_camera.R * kCamera.back_project(pixel, 1.0);
    return T_target_camera.t + ray * ((offset_m - normal.dot(T_target_camera.t)) / normal.dot(ray));
  }
  std::vector<std::uint8_t> seen(const CameraFromTarget& pose) const {
    std::vector<std::uint8_t> image;
    for (int v = 0; v < kCamera.height_px; ++v) {
      for (int u = 0; u < kCamera.width_px; ++u) {
        const Vector3 p = hit(pose, Vector2(u, v));
        const double light = std::sin(60.0 * p.x()) + std::cos(70.0 * p.y() + 20.0 * p.x());
        image.push_back(static_cast<std::uint8_t>(std::lround(brightness + contrast * light)));
      }
    }
    return image;
  }
  Feature feature(const CameraFromTarget& pose, const Vector2& pixel) const {
    const auto disparity = [&](const Vector2& at) {
      return kCamera.fx_px * kCamera.baseline_m / (pose * hit(pose, at)).z();
    };
    Feature out;
    out.pixel = pixel;
    out.right_u_px = pixel.x() - disparity(pixel);
    out.depth_m = kCamera.depth_m(disparity(pixel));
    out.disparity_slope = {disparity(pixel + Vector2(1.0, 0.0)) - disparity(pixel),
                           disparity(pixel + Vector2(0.0, 1.0)) - disparity(pixel)};
    return out;
  }
};

std::vector<PyramidLevel> pyramid_of(const std::vector<std::uint8_t>& image) {
  return {{{image.data(), kCamera.width_px, kCamera.height_px}}};
}

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
