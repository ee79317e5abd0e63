// SPDX-License-Identifier: Apache-2.0
// Faults of the target or of this computer, and their effect on poses, status and log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/host/daemon/captured_log.hpp"
#include "unit/host/daemon/lighthouse_pipeline_fixture.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class TargetPipelineFaults : public TargetPipelineTest {
 protected:
  std::vector<std::string> log_lines(const std::string& words) const { return log_.lines(words); }
  // Nothing is received for `seconds`.
  void pause(std::int64_t seconds) { ticks_ += seconds * kTicksPerSecond; }
  void calibrate() {
    for (int i = 0; i < 2; ++i) push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
    push_cycles(2);
    ASSERT_EQ(poses().back().flags, "");
  }

 private:
  test::CapturedLog log_;
};

TEST_F(TargetPipelineFaults, ACalibrationOutlivesADarknessShorterThan240SecondsAndNoLonger) {
  push_cycles(20);
  calibrate();
  pause(239);
  push_cycles(2);
  EXPECT_EQ(poses().back().flags, "") << "the decoder still knows its stations";
  pause(241);
  push_cycles(2);
  EXPECT_EQ(poses().back().flags, "uncalibrated") << "another station may have taken the number";
  EXPECT_EQ(poses().back().station_or_camera, "");
  push(target_.ootx(ticks_, 0xBEC08E38), ticks_);  // accepted before: once is enough
  push_cycles(2);
  EXPECT_EQ(poses().back().flags, "");
}

// The daemon may start long after the board: its first sweep does not end a dark interval, and OOTX frames received
// before that sweep remain valid.
TEST_F(TargetPipelineFaults, WhatWasHeardBeforeTheFirstSweepHoldsHoweverLongTheBoardHasRun) {
  pause(3600);
  for (int i = 0; i < 2; ++i) push(target_.ootx(ticks_, 0xBEC08E38), ticks_);
  push_cycles(20);
  EXPECT_EQ(poses().back().flags, "");
  EXPECT_EQ(poses().back().station_or_camera, "BEC08E38");
}

TEST_F(TargetPipelineFaults, OneFalseTimeCostsNeitherCalibrationNorTimes) {
  push_cycles(60);
  calibrate();
  for (const std::int64_t false_s : {1000, -5, 2, -3}) {
    const std::size_t before = poses().size();
    push(target_.time(ticks_ + false_s * kTicksPerSecond), ticks_);
    push_cycles(20);
    EXPECT_EQ(poses().size(), before + 20) << false_s << " s";
    EXPECT_EQ(poses().back().flags, "") << false_s << " s";
  }
  EXPECT_EQ(counter("target_restarts"), 0);
  EXPECT_EQ(counter("clock.pairs_ignored"), 4);
}

TEST_F(TargetPipelineFaults, TheComputersClockSetBackIsReportedOnceAndStandsInThePosesThatFollow) {
  push_cycles(120);
  const std::int64_t before_us = poses().back().utime;
  EXPECT_EQ(pipeline_.clock_notice(now_ns()), "");
  utc_minus_monotonic_ns_ -= 3 * 3600 * kSecond_ns;
  push_cycles(120);
  EXPECT_THAT(log_lines("clock was set"),
              ::testing::ElementsAre(AllOf(HasSubstr("dock: this computer's clock was set back by 10800.0 s"))));
  EXPECT_THAT(pipeline_.clock_notice(now_ns()), HasSubstr("set back by 10800.0 s"));
  EXPECT_EQ(counter("clock.host_jumps"), 1);
  EXPECT_LT(poses().back().utime, before_us) << "at once, not in hours";
  const std::int64_t arrival_us = arrival_at(ticks_, 0).utc_ns / 1000;
  EXPECT_NEAR(static_cast<double>(poses().back().utime), static_cast<double>(arrival_us), 2e4);
  EXPECT_EQ(list_.all<pose_t>("PHAROS_LIGHTHOUSE_POSE").size(),
            list_.all<bearings_t>("PHAROS_LIGHTHOUSE_BEARINGS").size());

  // A pose that is earlier than its predecessor has the flag; sequence numbers continue.
  for (std::size_t i = 1; i < poses().size(); ++i) {
    EXPECT_EQ(poses()[i].sequence, poses()[i - 1].sequence + 1);
    if (poses()[i].utime <= poses()[i - 1].utime) {
      EXPECT_THAT(poses()[i].flags, EndsWith("clock_set"));
    }
  }
  EXPECT_EQ(poses().back().flags, "uncalibrated|clock_set");
  EXPECT_EQ(list_.all<bearings_t>("PHAROS_LIGHTHOUSE_BEARINGS").back().flags, "uncalibrated|clock_set");

  pause(61);
  push_cycles(20);
  EXPECT_EQ(poses().back().flags, "uncalibrated") << "told long enough";
  EXPECT_EQ(pipeline_.clock_notice(now_ns()), "");
  EXPECT_EQ(log_lines("clock was set").size(), 1u);
}

TEST_F(TargetPipelineFaults, TheComputersClockSetForwardIsReportedToo) {
  push_cycles(120);
  utc_minus_monotonic_ns_ += 3600 * kSecond_ns;
  push_cycles(20);
  EXPECT_THAT(pipeline_.clock_notice(now_ns()), HasSubstr("set forward by 3600.0 s"));
  const std::int64_t arrival_us = arrival_at(ticks_, 0).utc_ns / 1000;
  EXPECT_NEAR(static_cast<double>(poses().back().utime), static_cast<double>(arrival_us), 2e4);
}

TEST_F(TargetPipelineFaults, TheBoardsCountersDoNotWrap) {
  std::int64_t truth = 0;
  for (int i = 0; i < 6; ++i, truth += 1'000'000'000) {
    push(target_.counters(static_cast<std::uint32_t>(truth)), ticks_);
    EXPECT_EQ(counter("decoder.edges_in"), truth);
  }
}

TEST_F(TargetPipelineFaults, ATargetThatStartsAnewCountsFromItsNewStart) {
  push(target_.hello("bench", ticks_, 1), ticks_);
  push(target_.counters(4'000'000'000), ticks_);
  push(target_.hello("bench", ticks_, 2), ticks_);
  push(target_.counters(3), ticks_);
  EXPECT_EQ(counter("decoder.edges_in"), 3);
}

TEST_F(TargetPipelineFaults, ATargetThatStartsAnewAllTheTimeDoesNotFillTheLog) {
  for (std::uint16_t start = 0; start < 300; ++start) {
    ticks_ += kTicksPerSecond / 100;
    push(target_.hello(start % 2 == 0 ? "left" : "right", ticks_, start), ticks_);
  }
  EXPECT_LE(log_lines("started anew").size(), 4u);
  EXPECT_LE(log_lines("speaks").size(), 4u);
  EXPECT_EQ(counter("target_restarts"), 299) << "every one is counted";
  const std::int64_t suppressed = counter("log_lines_held_back");
  EXPECT_GT(suppressed, 580);
  pause(11);
  push(target_.hello("left", ticks_, 999), ticks_);
  EXPECT_THAT(log_lines("started anew").back(), HasSubstr("295 more lines like this were held back"));
}

TEST_F(TargetPipelineFaults, TwoUnsupportedVersionsInTurnDoNotFillTheLog) {
  for (std::uint16_t i = 0; i < 200; ++i) push(frame_of_unsupported_version(i % 2 == 0 ? 7 : 9, i), ticks_);
  EXPECT_LE(log_lines("of the serial protocol").size(), 4u);
  EXPECT_GT(counter("log_lines_held_back"), 190);
}

TEST_F(TargetPipelineFaults, ManyStationIdsFillNeitherMemoryNorLog) {
  for (std::uint32_t id = 1; id <= 500; ++id) {
    for (int i = 0; i < 2; ++i) push(target_.ootx(ticks_, id), ticks_);
  }
  EXPECT_EQ(memory_.stations().size(), CalibrationMemory::kMaxStations);
  EXPECT_EQ(memory_.counters().dropped, 500 - static_cast<std::int64_t>(CalibrationMemory::kMaxStations));
  EXPECT_LE(log_lines("calibration of station").size(), 4u);
}

}  // namespace
}  // namespace pharos::host
