// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/described_turn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/tof/tof_pose.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::facing;
using test::render;
using test::SyntheticRing;

constexpr double kSide_m = 0.12;

class DescribedTurns : public testing::Test {
 protected:
  void describe(const Vector2& place, double height_m = -0.03) {
    settings_.target.connectors.push_back({place, height_m, {kSide_m, kSide_m}, 0.001, 0.001});
  }
  TofPose measure(const std::vector<Vector2>& plates) const {
    SyntheticRing scene;
    scene.plates = plates;
    // A new one each time: frames without noise repeat rows, as stale ones do.
    const auto workspace = std::make_unique<TofWorkspace>();
    const auto pose = measure_tof_pose(render(scene, truth_, camera_).view(), camera_, settings_, *workspace);
    EXPECT_TRUE(pose.ok()) << name_of(pose.error());
    return pose.ok() ? *pose : TofPose{};
  }
  double turn_error_deg(const TargetPose& pose) const {
    return rotation_angle_between(pose.pose.R, truth_.R) * kDegPerRad;
  }

  TofSettings settings_;
  DepthCamera camera_ = test::small_camera();
  CameraFromTarget truth_ = facing({0.05, 0.02, 2.3}, {0.2, 0.1, 0.7});
};

TEST_F(DescribedTurns, AnyOneConnectorGivesIt) {
  const Vector2 near(0.64, 0.1), far(-0.2, 0.70);
  describe(near);
  describe(far);
  for (const std::vector<Vector2>& seen : {std::vector{near}, std::vector{far}, std::vector{near, far}}) {
    const TofPose pose = measure(seen);
    ASSERT_TRUE(pose.has_turn());
    EXPECT_FALSE(pose.ambiguous());
    EXPECT_LT(turn_error_deg(pose.target), 0.2);
  }
}

TEST_F(DescribedTurns, OneOfTwoAtEqualDistancesIsAmbiguous) {
  const Vector2 one(0.68, 0.0), other(0.68 * std::cos(1.2), 0.68 * std::sin(1.2));
  describe(one);
  describe(other);
  const TofPose pose = measure({one});
  ASSERT_TRUE(pose.ambiguous());
  EXPECT_LT(std::min(turn_error_deg(pose.target), turn_error_deg(*pose.second)), 0.2);
  EXPECT_LT(pose.delta_chi2, 9.21);
}

TEST_F(DescribedTurns, EqualDistancesAreToldApartByTheOthersPlaces) {
  const Vector2 one(0.68, 0.0), other(0.68 * std::cos(1.2), 0.68 * std::sin(1.2));
  describe(one);
  describe(other);
  const TofPose pose = measure({one, other});
  ASSERT_TRUE(pose.has_turn());
  EXPECT_FALSE(pose.ambiguous());
  EXPECT_LT(turn_error_deg(pose.target), 0.2);
}

TEST_F(DescribedTurns, ASymmetricTargetHasTwo) {
  describe({0.68, 0.0});
  describe({-0.68, 0.0});
  const TofPose pose = measure({Vector2(0.68, 0.0), Vector2(-0.68, 0.0)});
  ASSERT_TRUE(pose.ambiguous());
  EXPECT_LT(std::min(turn_error_deg(pose.target), turn_error_deg(*pose.second)), 0.2);
  EXPECT_NEAR(std::max(turn_error_deg(pose.target), turn_error_deg(*pose.second)), 180.0, 0.3);
}

TEST_F(DescribedTurns, ABoxOfAnotherHeightIsNone) {
  describe({0.66, 0.0}, 0.15);
  EXPECT_FALSE(measure({Vector2(0.66, 0.0)}).has_turn());
}

// A wall or shadow that was taken for one of a face's edges shows in the length of that side.
TEST_F(DescribedTurns, ASideOfAnotherLengthWidensTheSigma) {
  describe({0.66, 0.0});
  const TofPose exact = measure({Vector2(0.66, 0.0)});
  settings_.target.connectors.clear();
  settings_.target.connectors.push_back({{0.66, 0.0}, -0.03, {kSide_m, kSide_m - 0.012}, 0.001, 0.001});
  const TofPose longer = measure({Vector2(0.66, 0.0)});
  ASSERT_TRUE(exact.has_turn() && longer.has_turn());
  const double before = std::sqrt(exact.target.covariance(2, 2)), after = std::sqrt(longer.target.covariance(2, 2));
  EXPECT_LT(before, 0.003);
  EXPECT_NEAR(std::sqrt(after * after - before * before), 0.006 / 0.66, 0.002);
}

TEST_F(DescribedTurns, HeightsMayCountFromThePlate) {
  describe({0.66, 0.0}, 0.07);
  const TofPose pose = measure({Vector2(0.66, 0.0)});
  ASSERT_TRUE(pose.has_turn());
  EXPECT_LT(turn_error_deg(pose.target), 0.2);
}

}  // namespace
}  // namespace pharos::tof
