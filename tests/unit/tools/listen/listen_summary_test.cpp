// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/listen_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/pose_t.hpp"
#include "tools/listen/listener.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {
namespace {

using ::testing::HasSubstr;

ReceivedPose pose(std::int64_t sequence, bool valid = true) {
  ReceivedPose received;
  received.channel = "C";
  received.source = "lighthouse/x";
  received.target = "dock";
  received.sequence = sequence;
  received.utime_us = sequence * 20'000;
  received.age_s = 0.004;
  received.status = valid ? "ok" : "refused_poor_fit";
  if (valid) received.pose = LighthouseFromBody{};
  return received;
}

TEST(ListenSummary, CountsLossesByGapsAndNotARestart) {
  ListenSummary summary;
  for (const std::int64_t sequence : {5, 6, 9, 0, 1, 3}) summary.add(pose(sequence), sequence);
  ASSERT_EQ(summary.sources().size(), 1u);
  EXPECT_EQ(summary.sources()[0].lost, 3);
  EXPECT_EQ(summary.poses(), 6);
}

TEST(ListenSummary, ARefusedCycleIsNoPose) {
  ListenSummary summary;
  summary.add(pose(0, false), 0);
  EXPECT_EQ(summary.poses(), 0);
  EXPECT_EQ(summary.sources()[0].refused, 1);
}

TEST(ListenSummary, RateIsThatOfTheLastSecond) {
  ListenSummary summary;
  double rate_hz = 0.0;
  for (int i = 0; i < 200; ++i) rate_hz = summary.add(pose(i), i * 20'000'000LL);
  EXPECT_EQ(rate_hz, 50.0);
  EXPECT_NEAR(summary.sources()[0].rate_hz(), 50.0, 1e-9);
}

TEST(ListenSummary, ErrorsComeAsRootMeanSquareAndMaximum) {
  ListenSummary summary;
  summary.add(pose(0), 0);
  summary.add_error(pose(0), {0.3, 0.001});
  summary.add_error(pose(1), {0.4, 0.007});
  const ErrorSums error = summary.sources()[0].error;
  EXPECT_DOUBLE_EQ(error.rms_rotation_rad(), std::sqrt(0.125));
  EXPECT_DOUBLE_EQ(error.rms_position_m(), 0.005);
  EXPECT_DOUBLE_EQ(error.max_rotation_rad, 0.4);
  EXPECT_DOUBLE_EQ(error.max_position_m, 0.007);
  EXPECT_THAT(summary_text(summary.sources()), HasSubstr("5.00 mm RMS, 7.00 mm largest"));
}

TEST(ListenSummary, UncalibratedPosesDoNotSpoilTheErrorsOfTheOthers) {
  ListenSummary summary;
  ReceivedPose uncalibrated = pose(0);
  uncalibrated.flags = "uncalibrated|outliers";
  summary.add(pose(1), 0);
  summary.add_error(uncalibrated, {0.05, 0.1});
  summary.add_error(pose(1), {0.001, 0.002});
  EXPECT_EQ(summary.sources()[0].error.count, 1);
  EXPECT_DOUBLE_EQ(summary.sources()[0].error.rms_position_m(), 0.002);
  EXPECT_DOUBLE_EQ(summary.sources()[0].uncalibrated_error.rms_position_m(), 0.1);
  EXPECT_THAT(summary_text(summary.sources()), HasSubstr("before calibration (1 poses)"));
}

TEST(PoseError, IsTheAngleBetweenAndTheDistance) {
  const LighthouseFromBody truth{rotation_exp(Vector3(0.1, 0.2, 0.3)), Vector3(1, 2, 3)};
  const LighthouseFromBody measured{rotation_exp(Vector3(0, 0.05, 0)) * truth.R, truth.t + Vector3(0.003, 0, 0.004)};
  EXPECT_NEAR(pose_error(measured, truth).rotation_rad, 0.05, 1e-12);
  EXPECT_NEAR(pose_error(measured, truth).position_m, 0.005, 1e-12);
}

TEST(PoseLine, ShowsMillimetresAndDegrees) {
  ReceivedPose received = pose(50);
  received.pose->t = Vector3(0.0015, -0.25, 3.0);
  received.error = PoseError{0.01, 0.002};
  const std::string line = pose_line(received);
  EXPECT_THAT(line, HasSubstr("00:00:01.000 dock -------- ok  t 1.50 -250.00 3000.00 mm"));
  EXPECT_THAT(line, HasSubstr("age 4.0 ms  error 2.00 mm 0.573 deg"));
}

TEST(Listener, PassesOverWhatItDoesNotKnow) {
  Listener listener(ListenFormat::kNone, std::nullopt);
  const char noise[] = "not a message";
  listener.take("C", noise, sizeof noise, 0, 0);
  EXPECT_EQ(listener.foreign(), 1);
  EXPECT_EQ(listener.summary().poses(), 0);
}

TEST(Listener, TakesAgeFromTheMeasurement) {
  pose_t message{};
  message.valid = 1;
  message.orientation_wxyz[0] = 1.0;
  message.utime = 1'000'000;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  Listener listener(ListenFormat::kNone, std::nullopt);
  listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 1'002'500'000, 0);
  ASSERT_EQ(listener.summary().poses(), 1);
  EXPECT_EQ(listener.summary().sources()[0].age.max_ns(), 2'500'000);
}

}  // namespace
}  // namespace pharos::tools
