// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pose_only.hpp"

#include <gtest/gtest.h>

#include "host/vision/slam/rigid_fit.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

TEST(PoseOnly, JacobianAgreesWithCentralDifferences) {
  std::mt19937_64 random(1);
  const CameraFromTarget pose = turned_pose(0.4);
  for (const Vector3& point : random_points(random, 20)) {
    const Observation at = seen(point, pose, 1.0, random);
    const auto J = residual_jacobian(at, kCamera, pose);
    for (int k = 0; k < 6; ++k) {
      Vector6 step = Vector6::Zero();
      step[k] = 1e-6;
      const Vector3 slope =
          (residual_of(at, kCamera, pose.moved_by(step)) - residual_of(at, kCamera, pose.moved_by(-step))) / 2e-6;
      EXPECT_LT((J.col(k) - slope).norm(), 1e-5 * (1.0 + slope.norm())) << "column " << k;
    }
  }
}

TEST(PoseOnly, FindsTheExactPoseAmongGrossOutliers) {
  std::mt19937_64 random(2);
  const CameraFromTarget truth = turned_pose(0.3);
  std::vector<Observation> observations;
  for (const Vector3& point : random_points(random, 100)) observations.push_back(seen(point, truth, 0.0, random));
  for (std::size_t k = 0; k < 30; ++k)
    observations[k].pixel += Vector2(25.0, -40.0) + random_vector(random, 10.0).head<2>();
  const PoseOnly placed =
      adjust_pose(observations, kCamera, truth.moved_by((Vector6() << 0.02, -0.01, 0.01, 0.02, 0.01, 0.05).finished()));
  EXPECT_LT(rotation_angle_between(placed.pose.R, truth.R), 1e-6);
  EXPECT_LT((placed.pose.t - truth.t).norm(), 1e-5);
  EXPECT_EQ(placed.inliers, 70);
  for (std::size_t k = 0; k < 30; ++k) EXPECT_FALSE(placed.inlier[k]);
}

TEST(PoseOnly, CovarianceDescribesItsErrors) {
  std::mt19937_64 random(3);
  const CameraFromTarget truth = turned_pose(-0.2);
  const std::vector<Vector3> points = random_points(random, 60);
  double sum = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<Observation> observations;
    for (const Vector3& point : points) observations.push_back(seen(point, truth, 0.4, random));
    const PoseOnly placed = adjust_pose(observations, kCamera, truth);
    const Vector6 error = pose_difference(truth, placed.pose);
    sum += error.dot(placed.covariance.inverse() * error);
  }
  // Chi-squared of 6 x 200 degrees of freedom: 6 +- 0.25 a run; the rejected observations increase it a little.
  EXPECT_NEAR(sum / kRuns, 6.0, 1.0);
}

// Three times the assumed noise: the residuals that pass the test of chi-squared are as assumed, all of them are not.
TEST(PoseOnly, VarianceFactorTellsNoiseThatTheTestOfChiSquaredHides) {
  std::mt19937_64 random(6);
  const CameraFromTarget truth = turned_pose(0.2);
  std::vector<Observation> as_assumed, noisier;
  for (const Vector3& point : random_points(random, 400)) {
    as_assumed.push_back(seen(point, truth, 0.2, random));
    noisier.push_back(seen(point, truth, 0.6, random));
    noisier.back().variance_px2 = 0.2 * 0.2;
  }
  EXPECT_NEAR(variance_factor(as_assumed, kCamera, truth), 1.05, 0.15);
  EXPECT_NEAR(variance_factor(noisier, kCamera, truth), 9.0, 1.5);
  noisier.resize(10);
  EXPECT_EQ(variance_factor(noisier, kCamera, truth), 1.0) << "too few to tell";
}

// Errors that neighbours have in common move the pose further than independent ones of that size do.
TEST(PoseOnly, CorrelationFactorTellsErrorsThatNeighboursShare) {
  constexpr int kRuns = 60, kTogether = 15;
  constexpr double kOwn_px = 0.2, kShared_px = 0.1;
  double independent = 0.0, shared = 0.0, stated = 0.0, as_independent = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run));
    std::normal_distribution<double> noise(0.0, kShared_px);
    const CameraFromTarget truth = turned_pose(0.2);
    std::vector<Observation> own, moved;
    for (const Vector3& middle : random_points(random, 30)) {
      const Vector2 move(noise(random), noise(random));
      for (int n = 0; n < kTogether; ++n) {
        own.push_back(seen(middle + random_vector(random, 0.05), truth, kOwn_px, random));
        moved.push_back(own.back());
        moved.back().pixel += move;
        moved.back().right_u_px += move.x();
        moved.back().variance_px2 = kOwn_px * kOwn_px + kShared_px * kShared_px;
      }
    }
    independent += correlation_factor(own, kCamera, adjust_pose(own, kCamera, truth)) / kRuns;
    const PoseOnly placed = adjust_pose(moved, kCamera, truth);
    const double factor = correlation_factor(moved, kCamera, placed);
    shared += factor / kRuns;
    const Vector6 error = pose_difference(truth, placed.pose);
    const double square = error.dot(placed.covariance.inverse() * error) / (6.0 * kRuns);
    as_independent += square;
    stated += square / factor;
  }
  EXPECT_GE(independent, 1.0);
  EXPECT_LT(independent, 1.2);
  EXPECT_GT(as_independent, 3.0);
  // The groups found are not those that share an error: some of it stays unseen.
  EXPECT_GT(shared, 1.6);
  EXPECT_GT(stated, 0.7);
  EXPECT_LT(stated, 0.7 * as_independent);
}

TEST(RigidFit, RecoversAMotionExactlyAndRefusesALine) {
  std::mt19937_64 random(4);
  const CameraFromTarget truth = turned_pose(2.5);
  std::vector<Vector3> points = random_points(random, 10), moved;
  for (const Vector3& point : points) moved.push_back(truth * point);
  const auto pose = rigid_fit(points, moved);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->R - truth.R).norm(), 1e-9);
  EXPECT_LT((pose->t - truth.t).norm(), 1e-9);
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = Vector3(static_cast<double>(k), 0.0, 0.0);
  EXPECT_FALSE(rigid_fit(points, points));
  EXPECT_FALSE(rigid_fit({points[0], points[1]}, {points[0], points[1]}));
}

TEST(RobustPose, NeedsNoStartAndHalfOfTheMatchesMayBeWrong) {
  std::mt19937_64 random(5);
  const CameraFromTarget truth = turned_pose(1.2);
  std::vector<Observation> observations;
  for (const Vector3& point : random_points(random, 80)) observations.push_back(seen(point, truth, 0.3, random));
  for (std::size_t k = 0; k < 40; ++k) observations[k].point_m = random_vector(random, 0.8);
  const auto placed = robust_pose(observations, kCamera, 20, 7);
  ASSERT_TRUE(placed);
  EXPECT_LT(rotation_angle_between(placed->pose.R, truth.R), 0.005);
  EXPECT_GE(placed->inliers, 35);
  const auto again = robust_pose(observations, kCamera, 20, 7);
  EXPECT_EQ(again->pose.R, placed->pose.R);
  for (Observation& at : observations) at.point_m = random_vector(random, 0.8);
  EXPECT_FALSE(robust_pose(observations, kCamera, 20, 7)) << "nothing agrees";
}

}  // namespace
}  // namespace pharos::slam
