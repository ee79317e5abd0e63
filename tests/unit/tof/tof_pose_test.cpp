// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/tof_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "pharos/base/units.hpp"
#include "support/allocation_guard.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::facing;
using test::render;
using test::SyntheticFrame;
using test::SyntheticRing;

double angle_deg(const Matrix3& a, const Matrix3& b) { return rotation_angle_between(a, b) * kDegPerRad; }

class TofPoseTest : public testing::Test {
 protected:
  Result<TofPose, TofFailure> measure(const SyntheticFrame& frame) const {
    return measure_tof_pose(frame.view(), camera_, settings_, *workspace_);
  }
  void SetUp() override { settings_.connector.expected = 1; }

  TofSettings settings_;
  DepthCamera camera_ = test::small_camera();
  std::unique_ptr<TofWorkspace> workspace_ = std::make_unique<TofWorkspace>();
};

TEST_F(TofPoseTest, NoiselessFramesGiveTheirPose) {
  const CameraFromTarget truth = facing({0.12, -0.07, 2.3}, {0.25, -0.2, 0.6});
  const auto pose = measure(render(SyntheticRing{}, truth, camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  EXPECT_EQ(pose->flags, 0);
  EXPECT_FALSE(pose->ambiguous());
  EXPECT_LT((pose->target.pose.t - truth.t).norm(), 0.0006);
  EXPECT_LT(angle_deg(pose->target.pose.R, truth.R), 0.12);
  EXPECT_NEAR(pose->ring.fit.model.radius(RingEdge::kOuter), 0.55, 0.0006);
  EXPECT_NEAR(pose->ring.fit.model.radius(RingEdge::kInner), 0.49, 0.0006);
}

TEST_F(TofPoseTest, FoilBrighterThanTheRingDoesNotMoveItsEdges) {
  const CameraFromTarget truth = facing({0.12, -0.07, 2.3}, {0.25, -0.2, 0.6});
  for (const double wall_grey : {4000.0, 20000.0}) {
    SyntheticRing scene;
    scene.wall_grey = wall_grey;
    const auto pose = measure(render(scene, truth, camera_));
    ASSERT_TRUE(pose.ok()) << wall_grey << ' ' << name_of(pose.error());
    EXPECT_TRUE(pose->has_turn());
    EXPECT_LT((pose->target.pose.t - truth.t).norm(), 0.0006) << wall_grey;
    EXPECT_LT(angle_deg(pose->target.pose.R, truth.R), 0.12) << wall_grey;
    EXPECT_NEAR(pose->ring.fit.model.radius(RingEdge::kInner), 0.49, 0.0006) << wall_grey;
  }
}

TEST_F(TofPoseTest, ARingThatOnlyDepthsShowIsFound) {
  SyntheticRing scene;
  scene.wall_grey = scene.plate_grey = scene.ring_grey;
  const CameraFromTarget truth = facing({0.12, -0.07, 2.3}, {0.25, -0.2, 0.6});
  const auto pose = measure(test::with_noise(render(scene, truth, camera_), 12.0, 60.0, 1));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  EXPECT_LT((pose->target.pose.t - truth.t).norm(), 0.003);
  EXPECT_LT(angle_deg(pose->target.pose.R, truth.R), 0.5);
}

TEST_F(TofPoseTest, PositionIsTheCirclesCentreNotItsImagesCentre) {
  // Near and tilted by 35 deg, where the two are 8 mm apart.
  const CameraFromTarget truth = facing({0.0, 0.0, 1.9}, {35.0 * kRadPerDeg, 0.0, 0.0});
  const auto pose = measure(render(SyntheticRing{}, truth, camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  const auto centre = project(camera_.intrinsics, truth.t);
  const double apart_px = std::hypot(pose->ring.outer.cx_px - centre->x(), pose->ring.outer.cy_px - centre->y());
  EXPECT_GT(apart_px, 3.0) << "the view does not tell the two apart";
  EXPECT_LT((pose->target.pose.t - truth.t).norm(), 0.001);
}

TEST_F(TofPoseTest, ErrorsAreWhatTheCovarianceSays) {
  SyntheticRing scene;
  const CameraFromTarget truth = facing({0.05, 0.02, 2.2}, {0.15, 0.1, -0.7});
  const SyntheticFrame clean = render(scene, truth, camera_);
  double nees = 0.0;
  constexpr int kFrames = 40;
  for (unsigned seed = 0; seed < kFrames; ++seed) {
    const auto pose = measure(test::with_noise(clean, 12.0, 60.0, seed));
    ASSERT_TRUE(pose.ok()) << name_of(pose.error());
    const Vector6 error = pose_difference(truth, pose->target.pose);
    nees += error.dot(pose->target.covariance.inverse() * error) / 6.0;
    EXPECT_LT(error.tail<3>().norm(), 0.003);
  }
  // The covariance also holds what these scenes lack: uneven foil and the connector's walls.
  EXPECT_GT(nees / kFrames, 0.35);
  EXPECT_LT(nees / kFrames, 1.8);
}

TEST_F(TofPoseTest, WithoutConnectorThereAreFiveDegreesOfFreedom) {
  SyntheticRing scene;
  scene.plates.clear();
  const CameraFromTarget truth = facing({0.0, 0.05, 2.3}, {0.2, 0.0, 0.9});
  const auto pose = measure(render(scene, truth, camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  EXPECT_EQ(pose->flags & kFlagNoConnector, kFlagNoConnector);
  EXPECT_FALSE(pose->has_turn());
  EXPECT_LT((pose->target.pose.t - truth.t).norm(), 0.001);
  EXPECT_LT(std::acos(pose->target.pose.R.col(2).dot(truth.R.col(2))) * kDegPerRad, 0.1);
  const Vector3 normal = pose->target.pose.R.col(2);
  EXPECT_GT(std::sqrt(normal.dot(pose->target.covariance.topLeftCorner<3, 3>() * normal)), 1.5);
}

TEST_F(TofPoseTest, TheNearerOfTwoConnectorsIsChosen) {
  SyntheticRing scene;
  scene.plates = {Vector2(0.66, 0.0), Vector2(0.0, 0.72)};
  settings_.connector.expected = 2;
  const CameraFromTarget truth = facing({0.0, 0.0, 2.4}, {0.0, 0.1, 2.0});
  const auto pose = measure(render(scene, truth, camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  EXPECT_FALSE(pose->ambiguous());
  EXPECT_LT(angle_deg(pose->target.pose.R, truth.R), 0.2);
}

TEST_F(TofPoseTest, TwoConnectorsAtOneDistanceAreAmbiguous) {
  SyntheticRing scene;
  scene.plates = {Vector2(0.68, 0.0), Vector2(0.0, 0.68)};
  settings_.connector.expected = 2;
  const CameraFromTarget truth = facing({0.0, 0.0, 2.4}, {0.0, 0.1, 2.0});
  const auto pose = measure(render(scene, truth, camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  ASSERT_TRUE(pose->ambiguous());
  const double first = angle_deg(pose->target.pose.R, truth.R);
  const double second = angle_deg(pose->second->pose.R, truth.R);
  EXPECT_LT(std::min(first, second), 0.2);
  EXPECT_NEAR(std::max(first, second), 90.0, 0.3);
}

TEST_F(TofPoseTest, MoreConnectorsThanTheTargetCarriesGiveNoTurn) {
  SyntheticRing scene;
  scene.plates = {Vector2(0.66, 0.0), Vector2(0.0, 0.72)};
  const auto pose = measure(render(scene, facing({0.0, 0.0, 2.4}, {0.0, 0.1, 2.0}), camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  EXPECT_FALSE(pose->has_turn());
}

TEST_F(TofPoseTest, ReportsEachStageInTurn) {
  struct Listener final : TofStageListener {
    void ended(TofStage stage) override { stages.push_back(stage); }
    std::vector<TofStage> stages;
  } listener;
  const SyntheticFrame frame = render(SyntheticRing{}, facing({0.05, 0.0, 2.3}, {0.2, 0.1, 0.4}), camera_);
  ASSERT_TRUE(measure_tof_pose(frame.view(), camera_, settings_, *workspace_, &listener).ok());
  const std::vector<TofStage> wanted = {TofStage::kCheck, TofStage::kEdges,     TofStage::kEllipses, TofStage::kPlane,
                                        TofStage::kRing,  TofStage::kConnector, TofStage::kPose};
  EXPECT_EQ(listener.stages, wanted);
}

TEST_F(TofPoseTest, TakesNoMemoryFromTheHeap) {
  const SyntheticFrame frame = render(SyntheticRing{}, facing({0.0, 0.0, 2.3}, {0.1, 0.1, 0.4}), camera_);
  const test::AllocationGuard guard;
  const bool ok = measure(frame).ok();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(ok);
}

TEST_F(TofPoseTest, DepthThatCountsFromTheHousingIsAccountedFor) {
  camera_.depth_origin_z_m = 0.043;
  const CameraFromTarget truth = facing({0.0, 0.0, 2.3}, {0.1, 0.1, 0.4});
  const auto pose = measure(render(SyntheticRing{}, truth, camera_));
  ASSERT_TRUE(pose.ok()) << name_of(pose.error());
  EXPECT_LT((pose->target.pose.t - truth.t).norm(), 0.001);
}

}  // namespace
}  // namespace pharos::tof
