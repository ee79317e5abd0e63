// SPDX-License-Identifier: Apache-2.0
// As many connectors are seen as told, and something that was not found as a box stands nearer.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "pharos/tof/connector_choice.hpp"
#include "pharos/tof/tof_pose.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::CameraFromTarget;
using test::facing;
using test::SyntheticRing;

class LookAlikes : public testing::Test {
 protected:
  /// The choice where the box at `not_found`, and slivers of it, are not among those found.
  ConnectorChoice choose(const SyntheticRing& scene, std::optional<Vector2> not_found, double tilt_rad = 0.0) const {
    const CameraFromTarget truth = facing({0.0, 0.0, 2.3}, {tilt_rad, 0.0, 0.4});
    const test::SyntheticFrame frame = render(scene, truth, camera_);
    TofSettings settings;
    settings.connector.expected = 1;
    const auto workspace = std::make_unique<TofWorkspace>();
    const auto pose = measure_tof_pose(frame.view(), camera_, settings, *workspace);
    EXPECT_TRUE(pose.ok()) << name_of(pose.error());
    if (!pose.ok()) return {};
    if (not_found) drop(not_found->norm(), workspace->raised);
    return choose_connector(frame.view(), camera_, workspace->rays, pose->ring.fit, settings.connector,
                            workspace->raised);
  }
  static SyntheticRing scene_of(const Vector2& connector, const Vector2& other, double other_side_m = 0.12) {
    SyntheticRing scene;
    scene.plates = {other, connector};
    scene.sides = {Vector2(other_side_m, other_side_m)};
    return scene;
  }

 private:
  static void drop(double distance_m, RaisedWorkspace& raised) {
    const auto boxes = raised.boxes;
    raised.boxes.clear();
    for (const RaisedBox& box : boxes) {
      if (std::fabs(box.distance_m() - distance_m) > 0.07) raised.boxes.push_back(box);
    }
  }

  DepthCamera camera_ = test::small_camera();
};

TEST_F(LookAlikes, WithoutOneTheTurnIsCertain) {
  SyntheticRing scene;
  scene.plates = {Vector2(0.0, 0.80)};
  const ConnectorChoice choice = choose(scene, std::nullopt);
  EXPECT_EQ(choice.seen.size(), 1u);
  EXPECT_EQ(choice.doubt, ConnectorDoubt::kNone);
}

TEST_F(LookAlikes, OneOutsideOfTheRingLeavesTheTurnOpen) {
  const Vector2 other(0.70, 0.0);
  const ConnectorChoice choice = choose(scene_of({0.0, 0.80}, other), other);
  EXPECT_EQ(choice.seen.size(), 1u);
  EXPECT_EQ(choice.doubt, ConnectorDoubt::kUnclear);
}

TEST_F(LookAlikes, OneInsideOfTheRingLeavesTheTurnOpen) {
  const Vector2 other(0.385, 0.0);
  EXPECT_EQ(choose(scene_of({0.0, 0.80}, other, 0.10), other).doubt, ConnectorDoubt::kUnclear);
}

// Up to 0.45 of the ring's radius and a connector's side beyond stands the nozzle.
TEST_F(LookAlikes, WhatStandsWhereTheNozzleDoesIsNone) {
  const Vector2 other(0.26, 0.0);
  EXPECT_EQ(choose(scene_of({0.0, 0.80}, other), other).doubt, ConnectorDoubt::kNone);
}

TEST_F(LookAlikes, WhatIsFartherIsNone) {
  const Vector2 other(0.86, 0.0);
  EXPECT_EQ(choose(scene_of({0.0, 0.70}, other), other).doubt, ConnectorDoubt::kNone);
}

// The walls of a tilted ring lie beside it in its plane, as far as the plate is deep: at 0.6 rad 70 mm more.
TEST_F(LookAlikes, BesideTheRingsWallsNothingIsTold) {
  const Vector2 other(0.615, 0.0);
  EXPECT_EQ(choose(scene_of({0.0, 0.80}, other), other).doubt, ConnectorDoubt::kUnclear);
  EXPECT_EQ(choose(scene_of({0.0, 0.80}, other), other, 0.6).doubt, ConnectorDoubt::kNone);
}

}  // namespace
}  // namespace pharos::tof
