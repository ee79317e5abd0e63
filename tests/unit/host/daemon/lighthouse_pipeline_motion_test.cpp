// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "pharos/base/units.hpp"
#include "unit/host/daemon/lighthouse_pipeline_fixture.hpp"

namespace pharos::host {
namespace {

/// The same target with the tracking method `motion`.
class MotionPipelineTest : public TargetPipelineTest {
 protected:
  void move_on(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      ticks_ += kCycle_ticks;
      motion_.push(target_.cycle(ticks_), arrival_at(ticks_));
    }
  }
  static Vector6 error_of(const pose_t& pose) {
    const Quaternion q(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                       pose.orientation_wxyz[3]);
    const Vector3 t(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
    return pose_difference({q.toRotationMatrix(), t}, pose_ahead());
  }

  LighthousePipeline motion_{
      config(TrackMethod::kMotion), PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, 0};
};

TEST(TargetConfigMethod, MotionUnlessConfiguredOtherwise) { EXPECT_EQ(TargetConfig{}.method, TrackMethod::kMotion); }

TEST_F(MotionPipelineTest, EverySweepBecomesAPoseWithItsTimeAndCovariance) {
  move_on(60);
  const auto all = poses();
  ASSERT_GE(all.size(), 90u);  // two per turn, except during the first 0.2 s, which map the clock
  for (std::size_t i = 2; i < all.size(); ++i) {
    EXPECT_EQ(all[i].status, "ok");
    EXPECT_EQ(all[i].sequence, all[i - 1].sequence + 1);
    // One turn later the last hit is on the same sensor by the same rotor.
    EXPECT_NEAR(static_cast<double>(all[i].utime - all[i - 2].utime), 16'667.0, 100.0);
    EXPECT_LT(error_of(all[i]).head<3>().norm(), 0.1 * kRadPerDeg);
    EXPECT_LT(error_of(all[i]).tail<3>().norm(), 1e-3);
  }
  // The last hit of the last sweep is at most half a turn older than the newest data.
  const double age_us =
      static_cast<double>(arrival_at(ticks_, 0).utc_ns) * 1e-3 - static_cast<double>(all.back().utime);
  EXPECT_GT(age_us, -2000.0);
  EXPECT_LT(age_us, 8400.0);
  EXPECT_EQ(all.back().observations, 6);
  for (int k = 0; k < 6; ++k) EXPECT_GT(all.back().covariance[7 * k], 0.0);
}

// A sweep that is received is published as a pose at once, without waiting for the other rotor's sweep.
TEST_F(MotionPipelineTest, APoseIsOneSweepOldAtTheMost) {
  constexpr std::int64_t kSweep_us = StationaryTarget::kHalfTurn_ticks / 50;
  constexpr std::int64_t kLine_us = kMillisecond_ns / 1000;
  move_on(60);
  for (int i = 0; i < 20; ++i) {
    const Axis axis = i % 2 == 0 ? Axis::kX : Axis::kY;
    const std::int64_t flash_ticks = ticks_ + StationaryTarget::kTurn_ticks - StationaryTarget::kTurn_ticks / 3;
    const std::size_t before = poses().size();
    ticks_ += StationaryTarget::kHalfTurn_ticks;
    const std::int64_t end_ticks = flash_ticks + StationaryTarget::kTurn_ticks / 3;
    motion_.push(target_.bytes_of(target_.sweep(axis, flash_ticks)), arrival_at(end_ticks));
    ASSERT_EQ(poses().size(), before + 1);
    const pose_t pose = poses().back();
    const std::int64_t old_us = arrival_at(end_ticks).utc_ns / 1000 - pose.utime;
    EXPECT_GT(old_us, 0);
    EXPECT_LT(old_us, kSweep_us + kLine_us);
    EXPECT_NEAR(static_cast<double>(pose.latency_us), static_cast<double>(old_us), 100.0);
  }
}

// Four coplanar sensors, nearly perpendicular to the line of sight and far away: the sign of the tilt is ambiguous.
TEST_F(MotionPipelineTest, TheSecondSolutionGoesWithThePose) {
  constexpr std::uint8_t kPlate = 4;
  TargetConfig flat = config(TrackMethod::kMotion);
  flat.target = StationaryTarget::target(kPlate);
  // With an uncalibrated station the poses would be too uncertain at these ranges.
  flat.calibrated_stations = {{std::nullopt, std::uint8_t{0}, lighthouse::StationCalibration{}}};
  const auto rotation_of = [](const double* wxyz) { return Quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]); };
  int ambiguous = 0, sure = 0;
  for (const double range_m : {3.0, 6.0, 8.0, 10.0}) {
    for (const double tilt_rad : {0.03, 0.05, 0.08}) {
      StationaryTarget plate({rotation_exp(Vector3(tilt_rad, 0.0, 0.4)), Vector3(0.05, 0.1, range_m)}, kPlate);
      LighthousePipeline pipeline(flat, PublishConfig{}, "lighthouse/plate", publisher_, clock_, memory_, 0);
      const std::size_t before = poses().size();
      for (int i = 0; i < 40; ++i) {
        ticks_ += kCycle_ticks;
        pipeline.push(plate.cycle(ticks_), arrival_at(ticks_));
      }
      const auto all = poses();
      for (std::size_t i = before; i < all.size(); ++i) {
        const pose_t& pose = all[i];
        EXPECT_EQ(pose.has_second, pose.status == "ambiguous");
        if (!pose.has_second) {
          EXPECT_EQ(pose.second_orientation_wxyz[0], 0.0);
          sure += pose.valid ? 1 : 0;
          continue;
        }
        ++ambiguous;
        EXPECT_TRUE(pose.valid);
        EXPECT_GE(pose.second_delta_chi2, 0.0);
        EXPECT_LT(pose.second_delta_chi2, 9.21);
        const Quaternion second = rotation_of(pose.second_orientation_wxyz), truth(plate.truth().R);
        EXPECT_NEAR(second.norm(), 1.0, 1e-9);
        const double nearer =
            std::min(rotation_of(pose.orientation_wxyz).angularDistance(truth), second.angularDistance(truth));
        EXPECT_LT(nearer, 4.0 * pose.sigma_rot_rad);
      }
    }
  }
  EXPECT_GT(ambiguous, 0);
  EXPECT_GT(sure, 0);
}

TEST_F(MotionPipelineTest, WhatIsKnownTooBadlyIsNoPose) {
  TargetConfig strict = config(TrackMethod::kMotion);
  strict.limits.position_m = 1e-7;
  LighthousePipeline pipeline(strict, PublishConfig{}, "lighthouse/strict", publisher_, clock_, memory_, 0);
  for (int i = 0; i < 40; ++i) {
    ticks_ += kCycle_ticks;
    pipeline.push(target_.cycle(ticks_), arrival_at(ticks_));
  }
  int uncertain = 0;
  for (const pose_t& pose : poses()) {
    EXPECT_FALSE(pose.valid);
    if (pose.status == "refused_too_uncertain") ++uncertain;
  }
  EXPECT_GT(uncertain, 30);
}

// One second of darkness: nothing is published in that time, and poses are correct from the first one afterwards.
TEST_F(MotionPipelineTest, ComesBackAfterDarknessWithoutAWrongPose) {
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

TEST_F(MotionPipelineTest, ATargetThatStartsAnewIsLookedForAnew) {
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
