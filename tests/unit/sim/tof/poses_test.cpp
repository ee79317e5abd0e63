// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/support/input_error.hpp"
#include "tools/sim/tof/tof_poses.hpp"
#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {
namespace {

TEST(PaperAngles, ZeroFacesTheCameraAndGammaTurnsXInThePicture) {
  const Matrix3 facing = attitude_of({});
  EXPECT_NEAR((facing.col(2) - Vector3(0, 0, -1)).norm(), 0.0, 1e-12);  // Z' towards the camera
  const Matrix3 turned = attitude_of({0.0, 0.0, -40.0});
  const double angle = 40.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR((turned.col(0) - Vector3(std::cos(angle), std::sin(angle), 0.0)).norm(), 0.0, 1e-12);  // down: +v
}

TEST(PaperAngles, ComeBackFromTheAttitude) {
  const PaperAngles angles = angles_of(attitude_of({-12.0, 31.0, 172.5}));
  EXPECT_NEAR(angles.alpha_deg, -12.0, 1e-9);
  EXPECT_NEAR(angles.beta_deg, 31.0, 1e-9);
  EXPECT_NEAR(angles.gamma_deg, 172.5, 1e-9);
}

TEST(RandomPoses, KeepTheirLimitsAndTheRingInThePicture) {
  const PixelRays rays(kPaperLens);
  const Satellite satellite = satellite_of_ring(1.1);
  RandomPoses limits;
  limits.count = 300;
  double largest_tilt = 0.0;
  for (const CameraFromTarget& pose : random_poses(limits, satellite, rays, RandomStream(3, "poses"))) {
    EXPECT_GE(pose.t.norm(), 2.5);
    EXPECT_LE(pose.t.norm(), 6.0);
    EXPECT_NEAR((pose.R.transpose() * pose.R - Matrix3::Identity()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(pose.R.determinant(), 1.0, 1e-12);
    const double tilt = std::acos(-pose.R.col(2).dot(pose.t.normalized())) * 180.0 / std::numbers::pi;
    EXPECT_LT(tilt, 35.0 + 1e-9);
    largest_tilt = std::max(largest_tilt, tilt);
    for (int i = 0; i < 90; ++i) {
      const double angle = i * std::numbers::pi / 45.0;
      const Vector2 pixel = rays.project(pose * Vector3(0.55 * std::cos(angle), 0.55 * std::sin(angle), 0.0));
      EXPECT_TRUE(pixel.x() > 7.0 && pixel.x() < 632.0 && pixel.y() > 7.0 && pixel.y() < 472.0);
    }
  }
  EXPECT_GT(largest_tilt, 30.0);
}

TEST(RandomPoses, SayWhenTheRingCannotFit) {
  RandomPoses limits;
  limits.min_range_m = limits.max_range_m = 0.8;
  EXPECT_THROW(random_poses(limits, satellite_of_ring(1.1), PixelRays(kPaperLens), RandomStream(1, "poses")),
               host::InputError);
}

TEST(Approach, GoesFromOneEndToTheOtherAndSpins) {
  Approach approach{{attitude_of({}), {0, 0, 5}}, {attitude_of({}), {0, 0, 3}}};
  approach.spin_deg_s = 3.0;
  EXPECT_NEAR(approach.at(0.0).t.z(), 5.0, 1e-12);
  EXPECT_NEAR(approach.at(5.0).t.z(), 4.0, 1e-12);
  EXPECT_NEAR(approach.at(10.0).t.z(), 3.0, 1e-12);
  EXPECT_NEAR(angles_of(approach.at(5.0).R).gamma_deg, 15.0, 1e-9);
}

TofScenario two_poses() {
  TofScenario scenario;
  const CameraFromTarget near{attitude_of({5.0, 0.0, 20.0}), {0.0, 0.0, 3.0}};
  const CameraFromTarget far{attitude_of({0.0, 5.0, 20.0}), {0.0, 0.0, 4.0}};
  scenario.poses = {near, near, far};
  return scenario;
}

TEST(TofSimulator, GivesTheSamePixelsForTheSameSeedInAnyOrder) {
  TofSimulator forward(two_poses(), 7);
  TofSimulator backward(two_poses(), 7);
  const TofPixels last = backward.pixels(2);
  const TofPixels first = backward.pixels(0);
  EXPECT_EQ(forward.pixels(0).depth, first.depth);
  EXPECT_EQ(forward.pixels(2).intensity, last.intensity);
  EXPECT_NE(forward.pixels(1).depth, first.depth);  // the same pose, other noise
  TofSimulator other(two_poses(), 8);
  EXPECT_NE(other.pixels(0).depth, first.depth);
}

TEST(TofSimulator, StaleFramesKeepTheLowerHalfOfTheFrameBefore) {
  TofScenario scenario = two_poses();
  scenario.stale_half_every = 2;
  TofSimulator stale(scenario, 7);
  TofSimulator fresh(two_poses(), 7);
  const TofPixels frame = stale.pixels(2);
  EXPECT_EQ(frame.depth[640 * 400 + 320], fresh.pixels(1).depth[640 * 400 + 320]);
  EXPECT_EQ(frame.depth[640 * 100 + 320], fresh.pixels(2).depth[640 * 100 + 320]);
}

TEST(TofSimulator, RawCoordinatesSayTheSameAsDepth) {
  TofSimulator simulator(two_poses(), 7);
  const TofPixels pixels = simulator.pixels(0);
  const RawCoordinates raw;
  const std::vector<std::uint8_t> bytes = abcy16_of(pixels, simulator.rays(), {}, raw);
  ASSERT_EQ(bytes.size(), 640u * 480u * 8u);
  int valid = 0;
  for (std::size_t i = 0; i < pixels.depth.size(); i += 97) {
    const auto word = [&](std::size_t k) { return bytes[8 * i + 2 * k] | bytes[8 * i + 2 * k + 1] << 8; };
    EXPECT_EQ(word(3), pixels.intensity[i]);
    if (pixels.depth[i] == 0) {
      EXPECT_EQ(word(2), 0xFFFF);
      continue;
    }
    ++valid;
    EXPECT_EQ(word(2), pixels.depth[i]);
    const int u = static_cast<int>(i % 640);
    const int v = static_cast<int>(i / 640);
    const double x = word(0) * raw.scale_m[0] + raw.offset_m[0];
    EXPECT_NEAR(x, simulator.rays().ray(u, v).x() * pixels.depth[i] * 0.00025, 0.000126);
  }
  EXPECT_GT(valid, 500);
}

}  // namespace
}  // namespace pharos::sim
