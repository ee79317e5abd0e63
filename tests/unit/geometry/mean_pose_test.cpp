// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/mean_pose.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pharos {
namespace {

using CameraFromTarget = Pose<frame::Camera, frame::Target>;

struct OnePose {
  CameraFromTarget pose;
  Matrix6 covariance = Matrix6::Identity();
};

// Near a half turn, where rotation vectors are discontinuous, and with differences too large for one exact step.
CameraFromTarget near_half_turn() { return {rotation_exp(Vector3(3.1, 0.2, -0.1)), Vector3(0.1, -0.2, 4.0)}; }

TEST(MeanOfPoses, OfOnePoseIsThatPose) {
  const std::vector<OnePose> one{{near_half_turn(), 4.0 * Matrix6::Identity()}};
  const auto mean = mean_of_poses(one);
  EXPECT_TRUE(mean.pose.R.isApprox(one[0].pose.R, 1e-14));
  EXPECT_EQ(mean.covariance, one[0].covariance);
  EXPECT_EQ(mean.reduced_chi2, 1.0);
}

TEST(MeanOfPoses, LeavesDifferencesThatSumToNothing) {
  std::vector<OnePose> poses;
  for (const Vector3& turn : {Vector3(0.5, 0.1, 0), Vector3(-0.2, 0.4, 0.3), Vector3(0.1, -0.6, 0.2)}) {
    Vector6 delta;
    delta << turn, 0.1 * turn;
    poses.push_back({near_half_turn().moved_by(delta)});
  }
  const auto mean = mean_of_poses(poses);
  Vector6 sum = Vector6::Zero();
  for (const OnePose& one : poses) sum += pose_difference(one.pose, mean.pose);
  EXPECT_LT(sum.norm(), 1e-11);
}

TEST(MeanOfPoses, IsKnownBetterByTheRootOfTheCountUnlessThePosesDisagree) {
  std::vector<OnePose> poses(4, {near_half_turn()});
  EXPECT_TRUE(mean_of_poses(poses).covariance.isApprox(Matrix6::Identity() / 4.0));
  // One axis at +-3 sigma: chi-squared 36 of 18 degrees of freedom.
  for (std::size_t i = 0; i < 4; ++i) {
    Vector6 delta = Vector6::Zero();
    delta[5] = i % 2 == 0 ? 3.0 : -3.0;
    poses[i].pose = near_half_turn().moved_by(delta);
  }
  const auto mean = mean_of_poses(poses);
  EXPECT_NEAR(mean.reduced_chi2, 2.0, 1e-12);
  EXPECT_TRUE(mean.covariance.isApprox(2.0 * Matrix6::Identity() / 4.0));
}

}  // namespace
}  // namespace pharos
