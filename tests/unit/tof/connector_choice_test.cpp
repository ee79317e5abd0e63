// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_choice.hpp"

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
using test::SyntheticFrame;
using test::SyntheticRing;

class ConnectorChoices : public testing::Test {
 protected:
  TofPose measure(const SyntheticFrame& frame) const {
    // A new one each time: frames without noise repeat rows, as stale ones do.
    const auto workspace = std::make_unique<TofWorkspace>();
    const auto pose = measure_tof_pose(frame.view(), camera_, settings_, *workspace);
    EXPECT_TRUE(pose.ok()) << name_of(pose.error());
    return pose.ok() ? *pose : TofPose{};
  }
  double turn_error_deg(const TofPose& pose) const {
    return rotation_angle_between(pose.target.pose.R, truth_.R) * kDegPerRad;
  }
  // Without depth where a disc of T's plane would appear.
  void hide(const Vector2& place, double radius_m, SyntheticFrame& frame) const { put(place, radius_m, 0.0, frame); }
  // Something before the satellite, at `nearer` times the depth.
  void put(const Vector2& place, double radius_m, double nearer, SyntheticFrame& frame) const {
    const Pose<frame::Target, frame::Camera> inverse = truth_.inverse();
    for (int v = 0; v < frame.height_px; ++v) {
      for (int u = 0; u < frame.width_px; ++u) {
        const Vector2 ray = *undistort(camera_.intrinsics, Vector2(u, v));
        const Vector3 d = inverse.R * Vector3(ray.x(), ray.y(), 1.0);
        const Vector3 at = inverse.t - inverse.t.z() / d.z() * d;
        if ((at.head<2>() - place).norm() < radius_m) {
          std::uint16_t& depth = frame.depth[static_cast<std::size_t>(v * frame.width_px + u)];
          depth = static_cast<std::uint16_t>(nearer * depth);
        }
      }
    }
  }

  TofSettings settings_;
  DepthCamera camera_ = test::small_camera();
  CameraFromTarget truth_ = facing({0.05, 0.02, 2.3}, {0.2, 0.1, 0.7});
};

TEST_F(ConnectorChoices, OneOfTwoGivesTheTurnWhereAllNearerPlacesAreThePlates) {
  const TofPose pose = measure(render(SyntheticRing{}, truth_, camera_));
  ASSERT_TRUE(pose.has_turn());
  EXPECT_LT(turn_error_deg(pose), 0.15);
}

TEST_F(ConnectorChoices, AHiddenPlaceThatIsNearerLeavesTheTurnOpen) {
  SyntheticFrame frame = render(SyntheticRing{}, truth_, camera_);
  hide({-0.35, 0.1}, 0.1, frame);
  const TofPose pose = measure(frame);
  EXPECT_FALSE(pose.has_turn());
  EXPECT_NE(pose.flags & kFlagFewConnectors, 0);
  settings_.connector.expected = 1;
  EXPECT_TRUE(measure(frame).has_turn());
}

// It may be a cover, and both connectors stand behind what hides a part of the face.
TEST_F(ConnectorChoices, OneOfTwoWhileSomethingHidesMoreThanAConnectorLeavesTheTurnOpen) {
  SyntheticFrame frame = render(SyntheticRing{}, truth_, camera_);
  put({-0.2, 0.83}, 0.12, 0.7, frame);  // all nearer places are the plate's
  const TofPose pose = measure(frame);
  EXPECT_FALSE(pose.has_turn());
  EXPECT_NE(pose.flags & kFlagFewConnectors, 0);
}

TEST_F(ConnectorChoices, ADarkConnectorIsOneToo) {
  SyntheticRing scene;
  scene.plate_grey = 900.0;  // the foil has 1500, the ring 8000
  settings_.connector.expected = 1;
  const TofPose pose = measure(test::with_noise(render(scene, truth_, camera_), 12.0, 20.0, 1));
  ASSERT_TRUE(pose.has_turn());
  EXPECT_LT(turn_error_deg(pose), 0.5);
}

TEST_F(ConnectorChoices, ACoverIsNoConnector) {
  SyntheticRing scene;
  scene.plates = {Vector2(-0.1, 0.62), Vector2(0.66, 0.0)};
  scene.sides = {Vector2(0.28, 0.09)};
  settings_.connector.expected = 1;
  const TofPose pose = measure(render(scene, truth_, camera_));
  ASSERT_TRUE(pose.has_turn());
  EXPECT_LT(turn_error_deg(pose), 0.15);
}

TEST_F(ConnectorChoices, ASquareCoverOfAnotherSizeLeavesTheTurnOpen) {
  SyntheticRing scene;
  scene.plates = {Vector2(0.0, 0.68), Vector2(0.66, 0.0)};
  scene.sides = {Vector2(0.19, 0.19)};
  EXPECT_FALSE(measure(render(scene, truth_, camera_)).has_turn());
  settings_.connector.expected = 1;
  EXPECT_FALSE(measure(render(scene, truth_, camera_)).has_turn());
}

TEST_F(ConnectorChoices, PixelsOfEdgesWithoutDepthCostNoAccuracy) {
  SyntheticFrame frame = render(SyntheticRing{}, truth_, camera_);
  const std::int32_t whole = measure(frame).ring.fit.edge_points;
  const SyntheticFrame clean = frame;
  for (int v = 1; v + 1 < frame.height_px; ++v) {
    for (int u = 1; u + 1 < frame.width_px; ++u) {
      const auto at = static_cast<std::size_t>(v * frame.width_px + u);
      const int left = clean.depth[at - 1], right = clean.depth[at + 1];
      const auto row = static_cast<std::size_t>(frame.width_px);
      const int above = clean.depth[at - row], below = clean.depth[at + row];
      const int own = clean.depth[at];
      const auto mixed = [own](int a, int b) {
        return std::min(std::abs(own - a), std::abs(own - b)) > 60 && std::abs(a - b) > 250;
      };
      if (mixed(left, right) || mixed(above, below)) frame.depth[at] = 0;
    }
  }
  const TofPose pose = measure(frame);
  EXPECT_GT(pose.ring.fit.edge_points, 3 * whole / 4);
  EXPECT_LT((pose.target.pose.t - truth_.t).norm(), 0.001);
}

}  // namespace
}  // namespace pharos::tof
