// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "pharos/base/units.hpp"
#include "unit/host/daemon/target_line_fixture.hpp"

namespace pharos::host {
namespace {

/// The same target, tracked with its motion.
class MotionLineTest : public TargetLineTest {
 protected:
  void move_on(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      ticks_ += kCycleTicks;
      motion_.push(target_.cycle(ticks_), arrival_at(ticks_));
    }
  }
  static Vector6 error_of(const pose_t& pose) {
    const Quaternion q(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                       pose.orientation_wxyz[3]);
    const Vector3 t(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
    return pose_difference({q.toRotationMatrix(), t}, pose_ahead());
  }

  TargetLine motion_{config(TrackMethod::kMotion), PublishConfig{}, "lighthouse/test", publisher_, memory_, 0};
};

TEST(TargetConfigMethod, MotionUnlessToldOtherwise) { EXPECT_EQ(TargetConfig{}.method, TrackMethod::kMotion); }

TEST_F(MotionLineTest, EverySweepBecomesAPoseWithItsTimeAndCovariance) {
  move_on(60);
  const auto all = poses();
  ASSERT_GE(all.size(), 90u);  // two a turn, but for the 0.2 s that map the clock
  for (std::size_t i = 2; i < all.size(); ++i) {
    EXPECT_EQ(all[i].status, "ok");
    EXPECT_EQ(all[i].sequence, all[i - 1].sequence + 1);
    // The same sensor of the same rotor is the last one, a turn later.
    EXPECT_NEAR(static_cast<double>(all[i].utime - all[i - 2].utime), 16'667.0, 100.0);
    EXPECT_LT(error_of(all[i]).head<3>().norm(), 0.1 * kRadPerDeg);
    EXPECT_LT(error_of(all[i]).tail<3>().norm(), 1e-3);
  }
  // Last hit of the last sweep: within half a turn of the line's newest instant.
  const double age_us =
      static_cast<double>(arrival_at(ticks_, 0).utc_ns) * 1e-3 - static_cast<double>(all.back().utime);
  EXPECT_GT(age_us, -2000.0);
  EXPECT_LT(age_us, 8400.0);
  EXPECT_EQ(all.back().observations, 6);
  for (int k = 0; k < 6; ++k) EXPECT_GT(all.back().covariance[7 * k], 0.0);
}

// One second of darkness: nothing is told meanwhile, and what is told afterwards is right from its first word.
TEST_F(MotionLineTest, ComesBackAfterDarknessWithoutAWrongPose) {
  move_on(60);
  const std::size_t before = poses().size();
  ticks_ += kTicksPerSecond;
  motion_.push(target_.time(ticks_), arrival_at(ticks_));
  EXPECT_EQ(poses().size(), before);
  move_on(30);
  const auto all = poses();
  ASSERT_GT(all.size(), before + 50);
  std::size_t valid = 0;
  for (std::size_t i = before; i < all.size(); ++i) {
    if (!all[i].valid) continue;
    ++valid;
    EXPECT_LT(error_of(all[i]).tail<3>().norm(), 3e-3);
  }
  EXPECT_GT(valid, 50u);
}

TEST_F(MotionLineTest, ATargetThatStartsAnewIsLookedForAnew) {
  motion_.push(target_.hello("bench", ticks_, 1), arrival_at(ticks_));
  move_on(60);
  motion_.push(target_.hello("bench", ticks_, 2), arrival_at(ticks_));
  const std::size_t before = poses().size();
  move_on(60);
  EXPECT_GT(poses().size(), before + 80);
  EXPECT_LT(error_of(poses().back()).tail<3>().norm(), 1e-3);
  EXPECT_EQ(motion_.counters().target_restarts, 1);
}

}  // namespace
}  // namespace pharos::host
