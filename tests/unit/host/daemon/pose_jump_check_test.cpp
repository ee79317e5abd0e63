// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pose_jump_check.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

using Estimate = PoseEstimate<frame::Camera, frame::Target>;
constexpr std::int64_t kPosePeriod_ns = 33'333'333;

Estimate at(double x_m, double tilt_rad = 0.0, double sigma_m = 0.0005) {
  Estimate estimate;
  estimate.pose.R = rotation_exp(Vector3(tilt_rad, 0.0, 0.0));
  estimate.pose.t = Vector3(x_m, 0.0, 4.0);
  estimate.covariance = Matrix6::Identity() * sigma_m * sigma_m / 3.0;
  return estimate;
}

class PoseJumpCheckTest : public ::testing::Test {
 protected:
  bool next(const Estimate& estimate) { return check.passes(estimate, time_ns += kPosePeriod_ns); }
  void settle() {
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(next(at(0.0)));
  }
  PoseJumpCheck check;
  std::int64_t time_ns = 0;
};

TEST_F(PoseJumpCheckTest, ATargetThatMovesAndTurnsPasses) {
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(next(at(0.01 * i, 0.02 * i)));
}

TEST_F(PoseJumpCheckTest, NoiseOfTheStatedSizePasses) {
  settle();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(next(at(i % 2 == 0 ? 0.2 : 0.0, 0.0, 0.05)));
}

// Six frames of another sender once gave a pose with an error of 398 mm at a stated sigma of 0.47 mm.
TEST_F(PoseJumpCheckTest, SixFramesOfAnotherSenderGiveNoPose) {
  settle();
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(next(at(0.398, 0.0, 0.00047)));
  EXPECT_TRUE(next(at(0.0)));
}

TEST_F(PoseJumpCheckTest, FramesOfTwoSendersInTurnsNeverMoveThePose) {
  settle();
  for (int i = 0; i < 300; ++i) {
    EXPECT_FALSE(next(at(0.398)));
    EXPECT_TRUE(next(at(0.0)));
  }
}

TEST_F(PoseJumpCheckTest, AJumpOfTheAxisAloneIsRefusedToo) {
  settle();
  EXPECT_FALSE(next(at(0.0, 0.5)));
}

TEST_F(PoseJumpCheckTest, ATargetThatReallyMovedIsTakenAfterHalfASecond) {
  settle();
  int refused = 0;
  while (!next(at(0.9))) ++refused;
  EXPECT_GE(refused, PoseJumpCheck::kConfirmations);
  EXPECT_NEAR(refused, 15, 2);
  EXPECT_TRUE(next(at(0.9)));
}

TEST_F(PoseJumpCheckTest, PosesThatDoNotAgreeConfirmNothing) {
  settle();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(next(at(0.5 + 0.3 * (i % 3))));
}

TEST_F(PoseJumpCheckTest, AfterAPauseATargetThatIsElsewhereIsConfirmedFirst) {
  settle();
  time_ns += 2'000'000'000;
  EXPECT_FALSE(next(at(0.17))) << "who keeps the camera's frames away makes the pause";
  EXPECT_TRUE(next(at(0.05)));
}

// While two senders compete for a camera its own frames may be those that are lost.
TEST_F(PoseJumpCheckTest, NothingConfirmsAJumpWhileTwoSendersCompete) {
  settle();
  const std::int64_t until_ns = time_ns + PoseJumpCheck::kContested_ns;
  check.on_contests(1, time_ns);
  check.on_contests(1, time_ns + 1'000'000'000);  // the same one, told again
  while (time_ns + kPosePeriod_ns < until_ns) EXPECT_FALSE(next(at(0.17)));
  EXPECT_TRUE(next(at(0.0))) << "the camera's own are still taken";
  int refused = 0;
  while (!next(at(0.17))) ++refused;
  EXPECT_NEAR(refused, 15, 2);
}

}  // namespace
}  // namespace pharos::host
