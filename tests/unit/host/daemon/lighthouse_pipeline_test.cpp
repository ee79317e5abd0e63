// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/base/units.hpp"
#include "unit/host/daemon/lighthouse_pipeline_fixture.hpp"

namespace pharos::host {
namespace {

using ::testing::HasSubstr;

TEST_F(TargetPipelineTest, BytesBecomeThePoseThatMadeThem) {
  push_cycles(20);
  ASSERT_GE(poses().size(), 5u);  // the first 0.2 s map the clock
  const pose_t pose = poses().back();
  EXPECT_EQ(pose.status, "ok");
  EXPECT_EQ(pose.target, "dock");
  EXPECT_EQ(pose.source, "lighthouse/test");
  EXPECT_EQ(pose.flags, "uncalibrated");
  EXPECT_EQ(pose.observations, 12);
  const Quaternion q(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                     pose.orientation_wxyz[3]);
  const LighthouseFromBody measured{q.toRotationMatrix(),
                                    Vector3(pose.position_m[0], pose.position_m[1], pose.position_m[2])};
  const Vector6 error = pose_difference(measured, pose_ahead());
  EXPECT_LT(error.head<3>().norm(), 0.02 * kRadPerDeg);
  EXPECT_LT(error.tail<3>().norm(), 0.3e-3);
}

TEST_F(TargetPipelineTest, UtimeIsWhenTheLightWasMeasured) {
  push_cycles(60);
  // The mean time of the hits of a cycle that ends at ticks_ lies between its first flash and its end.
  const double end_us = static_cast<double>(arrival_at(ticks_, 0).utc_ns) * 1e-3;
  const double before_end_us = end_us - static_cast<double>(poses().back().utime);
  EXPECT_GT(before_end_us, -2000.0);
  EXPECT_LT(before_end_us, 16'000.0);
}

TEST_F(TargetPipelineTest, ADroppedFrameDoesNotMoveUtc) {
  constexpr int kBaud = 460'800;
  LighthousePipeline pipeline(config(), PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, kBaud);
  const auto push_into = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      ticks_ += kCycle_ticks;
      pipeline.push(target_.cycle(ticks_), arrival_at(ticks_, 5 * kMillisecond_ns));
    }
    return poses().back().utime - arrival_at(ticks_, 0).utc_ns / 1000;
  };
  const std::int64_t before_us = push_into(300);
  // A frame of the maximum length takes 11 ms on the wire; here it arrives together with the next one.
  StationaryTarget::Bytes garbage(500, 0x55);
  garbage.push_back(0);
  pipeline.push(garbage, arrival_at(ticks_, 5 * kMillisecond_ns));
  pipeline.push(target_.time(ticks_), arrival_at(ticks_, 5 * kMillisecond_ns));
  EXPECT_NEAR(static_cast<double>(push_into(600) - before_us), 0.0, 500.0);
}

TEST_F(TargetPipelineTest, AHelloOfAnotherStartDropsTheStateOfTheOldOne) {
  push(target_.hello("bench", ticks_, 1), ticks_);
  push_cycles(20);
  for (int i = 0; i < 2; ++i) push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
  push_cycles(2);
  ASSERT_FALSE(poses().empty());
  ASSERT_EQ(poses().back().flags, "");
  push(target_.hello("bench", ticks_, 1), ticks_);  // a repeated hello of the same start: no state is lost
  push_cycles(2);
  EXPECT_EQ(poses().back().flags, "");
  push(target_.hello("bench", ticks_, 2), ticks_);
  push_cycles(20);
  EXPECT_EQ(poses().back().flags, "uncalibrated");
  EXPECT_EQ(counter("target_restarts"), 1);
}

TEST_F(TargetPipelineTest, APoseAndItsBearingsShareTheirNumber) {
  push_cycles(20);
  const auto bearings = list_.all<bearings_t>("PHAROS_LIGHTHOUSE_BEARINGS");
  ASSERT_FALSE(bearings.empty());
  EXPECT_EQ(bearings.back().sequence, poses().back().sequence);
  ASSERT_EQ(bearings.back().count, 12);
  for (const bearing_t& bearing : bearings.back().bearings) {
    EXPECT_TRUE(bearing.used);
    EXPECT_LT(std::abs(bearing.residual_rad), 5 * kRadPerArcsec);
    EXPECT_EQ(bearing.raw_theta_rad, bearing.ideal_theta_rad);
  }
}

TEST_F(TargetPipelineTest, AStaleCycleIsCountedAndNeverSent) {
  push_cycles(60);
  const std::size_t before = poses().size();
  ticks_ += kCycle_ticks;
  push(target_.cycle(ticks_), ticks_, 500 * kMillisecond_ns);
  EXPECT_EQ(poses().size(), before);
  EXPECT_EQ(counter("cycles_stale"), 1);
  push_cycles(1);
  EXPECT_EQ(poses().size(), before + 1) << "one late cycle must not spoil the next";
}

TEST_F(TargetPipelineTest, TheAgeCountsTheWorkOnACycle) {
  push_cycles(60);
  const std::int64_t before_us = poses().back().latency_us;
  clock_.step_at_readings(50 * kMillisecond_ns);
  push_cycles(1);
  EXPECT_NEAR(static_cast<double>(poses().back().latency_us - before_us), 50'000.0, 1'000.0);
  const std::size_t sent = poses().size();
  clock_.step_at_readings(250 * kMillisecond_ns);
  push_cycles(1);
  EXPECT_EQ(poses().size(), sent);
  EXPECT_EQ(counter("cycles_stale"), 1);
}

TEST_F(TargetPipelineTest, ARefusedCycleIsReportedWithoutAPose) {
  push_cycles(20);
  const std::int64_t flash = ticks_ += kCycle_ticks;
  push(target_.bytes_of(target_.sweep(Axis::kX, flash, 2)), flash + kCycle_ticks / 3);
  push(target_.bytes_of(target_.sweep(Axis::kY, flash + StationaryTarget::kHalfTurn_ticks, 2)), flash + kCycle_ticks);
  EXPECT_EQ(poses().back().status, "refused_too_few_sensors");
  EXPECT_FALSE(poses().back().valid);
  EXPECT_EQ(counter("cycles_refused_too_few_sensors"), 1);
}

TEST_F(TargetPipelineTest, GarbageBetweenCyclesCostsNoPose) {
  push_cycles(20);
  const std::size_t before = poses().size();
  for (int i = 0; i < 10; ++i) {
    StationaryTarget::Bytes garbage;
    for (int k = 0; k < 300; ++k) garbage.push_back(static_cast<std::uint8_t>(k * 37 + i * 11));
    garbage.push_back(0);
    push(garbage, ticks_);
    push_cycles(1);
  }
  EXPECT_EQ(poses().size(), before + 10);
  EXPECT_GT(counter("link.garbage_bytes"), 2500);
}

TEST_F(TargetPipelineTest, CutInTheMiddleOfAFrameItTakesUpAgainAfterwards) {
  push_cycles(20);
  const std::size_t before = poses().size();
  StationaryTarget::Bytes cut = target_.cycle(ticks_ += kCycle_ticks);
  cut.resize(cut.size() - 30);
  push(cut, ticks_);
  pipeline_.line_lost();
  push_cycles(3);
  EXPECT_EQ(poses().size(), before + 3);
}

TEST_F(TargetPipelineTest, ATargetThatStartsAnewIsFollowedOnItsNewClock) {
  push_cycles(60);
  const std::size_t before = poses().size();
  const std::int64_t old_ticks = ticks_;
  ticks_ = kTicksPerSecond;
  start_ns_ += (old_ticks - ticks_) * 20 + 3'000 * kMillisecond_ns;  // three seconds of silence
  target_ = StationaryTarget(pose_ahead());
  push_cycles(60);
  EXPECT_EQ(counter("target_restarts"), 1);
  EXPECT_GT(poses().size(), before + 40);  // except during the 0.2 s that map the new clock
  const double age_us =
      static_cast<double>(arrival_at(ticks_, 0).utc_ns) * 1e-3 - static_cast<double>(poses().back().utime);
  EXPECT_LT(std::abs(age_us), 20'000.0) << "mapped with the new clock, not the old one";
}

TEST_F(TargetPipelineTest, ACalibrationIsUsedFromItsSecondArrivalAndRemembered) {
  push_cycles(20);
  push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
  push_cycles(1);
  EXPECT_EQ(poses().back().flags, "uncalibrated");
  push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
  push_cycles(1);
  EXPECT_EQ(poses().back().flags, "");
  EXPECT_EQ(poses().back().station_or_camera, "BEC08E38");
  ASSERT_EQ(memory_.stations().size(), 1u);

  // After a restart of the daemon one reception is enough.
  LighthousePipeline again(config(), PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, 0);
  StationaryTarget board(pose_ahead());
  again.push(board.ootx(ticks_, 0xBEC08E38), arrival_at(ticks_));
  EXPECT_EQ(again.counters().calibrations_taken, 1);
}

TEST_F(TargetPipelineTest, ACalibrationFileGoesBeforeWhatTheStationSends) {
  constexpr double kPhase_rad = 0.01;
  TargetConfig calibrated = config();
  calibrated.calibration_file = "calibrated.toml";
  calibrated.scale_sigma = 0.005;
  calibrated.calibrated_stations.resize(1);
  calibrated.calibrated_stations[0].id = 0xBEC08E38;
  calibrated.calibrated_stations[0].calibration.id = 0xBEC08E38;
  calibrated.calibrated_stations[0].calibration.rotor[0].phase_rad = kPhase_rad;
  LighthousePipeline pipeline(calibrated, PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, 0);
  const auto push_into = [&](const StationaryTarget::Bytes& bytes) { pipeline.push(bytes, arrival_at(ticks_)); };
  const auto push_turns = [&] {
    for (int i = 0; i < 20; ++i) {
      ticks_ += kCycle_ticks;
      push_into(target_.cycle(ticks_));
    }
  };
  push_turns();
  const pose_t before = poses().back();
  push_into(target_.ootx(ticks_, 0xBEC08E38));
  push_into(target_.ootx(ticks_, 0xBEC08E38));
  push_turns();
  const pose_t after = poses().back();
  EXPECT_EQ(after.flags, "");
  EXPECT_NEAR(std::abs(after.position_m[0] - before.position_m[0]), kPhase_rad * 2.0, 0.2 * kPhase_rad * 2.0);
  // The uncertainty of the target's size is in the range's variance from the first pose on.
  EXPECT_GT(std::sqrt(before.covariance[6 * 5 + 5]), 0.005 * 2.0);
}

TEST_F(TargetPipelineTest, ACalibrationReadAgainHoldsAtOnceAndTheSameOneDisturbsNothing) {
  constexpr double kPhase_rad = 0.01;
  push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
  push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
  push_cycles(20);
  const pose_t before = poses().back();
  const std::size_t count = poses().size();
  pipeline_.recalibrate(config());
  push_cycles(2);
  EXPECT_EQ(poses().size(), count + 2) << "the same calibration must not cost a pose";

  TargetConfig calibrated = config();
  calibrated.calibrated_stations.resize(1);
  calibrated.calibrated_stations[0].id = 0xBEC08E38;
  calibrated.calibrated_stations[0].calibration.id = 0xBEC08E38;
  calibrated.calibrated_stations[0].calibration.rotor[0].phase_rad = kPhase_rad;
  pipeline_.recalibrate(calibrated);
  push_cycles(20);
  const pose_t after = poses().back();
  EXPECT_EQ(after.flags, "");
  EXPECT_NEAR(std::abs(after.position_m[0] - before.position_m[0]), kPhase_rad * 2.0, 0.2 * kPhase_rad * 2.0);
}

TEST_F(TargetPipelineTest, LimitsOfPublishingChangeWhileRunning) {
  push_cycles(20);
  PublishConfig strict;
  strict.max_age_s = 0.5e-3;  // less than the delay of the bytes
  pipeline_.set_publish(strict);
  const std::size_t count = poses().size();
  push_cycles(5);
  EXPECT_EQ(poses().size(), count);
  EXPECT_EQ(counter("cycles_stale"), 5);
}

TEST_F(TargetPipelineTest, AnotherProtocolVersionIsNamedInItsHealth) {
  for (std::uint16_t i = 0; i < 3; ++i) push(frame_of_unsupported_version(9, i), ticks_);
  const SourceHealth health = pipeline_.health("/dev/x", SourceState::kOk, "", now_ns());
  EXPECT_EQ(health.state, SourceState::kError);
  EXPECT_THAT(health.message, HasSubstr("speaks version 9"));
}

TEST_F(TargetPipelineTest, HealthGoesFromSilenceToPoses) {
  EXPECT_EQ(health().state, SourceState::kWaiting);
  push({1, 2, 3, 4, 5, 6, 7, 8, 9, 0}, ticks_);
  EXPECT_THAT(health().message, HasSubstr("baud rate"));
  push(target_.time(ticks_), ticks_);
  EXPECT_THAT(health().message, HasSubstr("sees no station"));
  push_cycles(60);
  const SourceHealth now = health();
  EXPECT_EQ(now.state, SourceState::kOk);
  EXPECT_GE(now.pose_age_ns, 0);
  const SourceHealth later = pipeline_.health("", SourceState::kOk, "", now_ns() + 5'000 * kMillisecond_ns);
  EXPECT_EQ(later.state, SourceState::kStale);
  EXPECT_THAT(later.message, HasSubstr("silent"));
}

TEST_F(TargetPipelineTest, ReportsTheSenderAndTheBoardsCounters) {
  push(target_.hello("test board"), ticks_);
  push(target_.counters(4711), ticks_);
  EXPECT_EQ(pipeline_.health("", SourceState::kOk, "", 0).identity, "test board 0.1.0 (simulated)");
  EXPECT_EQ(counter("decoder.edges_in"), 4711);
}

TEST_F(TargetPipelineTest, WhatThePortSaysGoesBeforeWhatThePipelineSays) {
  push_cycles(60);
  const SourceHealth health = pipeline_.health("/dev/x", SourceState::kGone, "/dev/x: no such device", now_ns());
  EXPECT_EQ(health.state, SourceState::kGone);
  EXPECT_EQ(health.message, "/dev/x: no such device");
}

TEST_F(TargetPipelineTest, ATargetOutOfSightIsToldWithinHalfASecond) {
  EXPECT_FALSE(pipeline_.state_changed(now_ns())) << "nothing was seen yet";
  push_cycles(40);
  ASSERT_TRUE(poses().back().valid);
  EXPECT_TRUE(pipeline_.state_changed(now_ns()));
  EXPECT_FALSE(pipeline_.state_changed(now_ns()));
  EXPECT_FALSE(pipeline_.state_changed(now_ns() + 200 * kMillisecond_ns));
  EXPECT_TRUE(pipeline_.state_changed(now_ns() + 400 * kMillisecond_ns));
  push_cycles(2);
  EXPECT_TRUE(pipeline_.state_changed(now_ns()));
}

// Otherwise another target on this port would be measured with this target's sensor positions and reported by its name.
TEST_F(TargetPipelineTest, ABoardThatIsNotTheExpectedOneIsRefusedAndTold) {
  TargetConfig certain = config();
  certain.identity.sensors = 5;  // the test's board has StationaryTarget::kSensors
  LighthousePipeline pipeline(certain, PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, 0);
  const auto cycles = [&](int count) {
    for (int i = 0; i < count; ++i) {
      ticks_ += kCycle_ticks;
      pipeline.push(target_.cycle(ticks_), arrival_at(ticks_));
    }
  };
  cycles(40);
  ASSERT_FALSE(poses().empty());
  EXPECT_EQ(poses().back().status, "refused_wrong_target") << "it has not said who it is";
  pipeline.push(target_.hello("test board", ticks_), arrival_at(ticks_));
  cycles(2);
  EXPECT_EQ(poses().back().status, "refused_wrong_target");
  EXPECT_FALSE(poses().back().valid);
  EXPECT_EQ(poses().back().position_m[2], 0.0);
  const SourceHealth health = pipeline.health("", SourceState::kOk, "", now_ns());
  EXPECT_EQ(health.state, SourceState::kError);
  EXPECT_NE(health.message.find("sensors, not 5"), std::string::npos) << health.message;
}

TEST_F(TargetPipelineTest, TheExpectedBoardIsAnsweredOnceItHasSaidWhoItIs) {
  TargetConfig certain = config();
  certain.identity.sensors = StationaryTarget::kSensors;
  LighthousePipeline pipeline(certain, PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, 0);
  pipeline.push(target_.hello("test board", ticks_), arrival_at(ticks_));
  for (int i = 0; i < 40; ++i) {
    ticks_ += kCycle_ticks;
    pipeline.push(target_.cycle(ticks_), arrival_at(ticks_));
  }
  ASSERT_FALSE(poses().empty());
  EXPECT_EQ(poses().back().status, "ok");
  pipeline.line_lost();  // the board's identity is unknown now
  for (int i = 0; i < 3; ++i) {
    ticks_ += kCycle_ticks;
    pipeline.push(target_.cycle(ticks_), arrival_at(ticks_));
  }
  EXPECT_EQ(poses().back().status, "refused_wrong_target");
}

}  // namespace
}  // namespace pharos::host
