// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/listen_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/status_t.hpp"
#include "tools/listen/listener.hpp"
#include "tools/listen/pointing_rows.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

// Whoever reaches LCM chooses the texts.
TEST(PoseRows, ATableHasNoEscapeSequenceOfAnother) {
  for (const host::RowFormat format : {host::RowFormat::kCsv, host::RowFormat::kJson}) {
    char* text = nullptr;
    std::size_t size = 0;
    std::FILE* stream = open_memstream(&text, &size);
    {
      host::RowWriter rows(stream, format, pose_columns());
      ReceivedPose received = pose(1);
      received.source = received.target = received.station_id = received.status = received.flags =
          "\x1b[2J\xc2\x9b"
          "1m\xff\x7f\n";
      write_pose_row(rows, received);
    }
    std::fclose(stream);
    const std::string table(text, size);
    std::free(text);
    EXPECT_THAT(table, HasSubstr("?[2J??1m???"));
    const auto is_plain = [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); };
    EXPECT_TRUE(std::all_of(table.begin(), table.end(), is_plain)) << table;
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), format == host::RowFormat::kCsv ? 2 : 1);
  }
}

TEST(ListenSummary, ThreeSourcesOnOneTargetAreThreeRows) {
  ListenSummary summary;
  for (const char* source : {"lighthouse/a", "lighthouse/b", "lighthouse/c"}) {
    ReceivedPose received = pose(0);
    received.source = source;
    summary.add(received, 0);
  }
  ASSERT_EQ(summary.sources().size(), 3u);
  EXPECT_THAT(summary_text(summary.sources()), HasSubstr("source lighthouse/b"));
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

TEST(ListenSummary, UncalibratedPosesDoNotAffectTheErrorsOfTheOthers) {
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

TEST(PoseNees, IsOneForAnErrorOfOneSigmaInEachDegreeOfFreedom) {
  Matrix6 covariance = Matrix6::Zero();
  Vector6 sigma;
  sigma << 1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3;
  covariance.diagonal() = sigma.cwiseAbs2();
  const LighthouseFromBody truth{rotation_exp(Vector3(0.1, 0.2, 0.3)), Vector3(1, 2, 3)};
  const auto nees = pose_nees(truth.moved_by(sigma), truth, covariance);
  ASSERT_TRUE(nees.has_value());
  EXPECT_NEAR(*nees, 1.0, 1e-9);
  EXPECT_FALSE(pose_nees(truth, truth, Matrix6::Zero()).has_value());
  ListenSummary summary;
  summary.add(pose(0), 0);
  summary.add_error(pose(0), {1e-3, 1e-3, nees});
  EXPECT_THAT(summary_text(summary.sources()), HasSubstr("NEES 1.00"));
}

TEST(PoseError, OfAPoseWithoutTurnIsItsTilt) {
  const LighthouseFromBody truth{rotation_exp(Vector3(3.0, 0.1, 0)), Vector3(0, 0, 4)};
  const Matrix3 turned = rotation_exp(Vector3(0, 0.02, 0)) * truth.R * rotation_exp(Vector3(0, 0, 1.3));
  const LighthouseFromBody measured{turned, truth.t};
  EXPECT_NEAR(pose_error(measured, truth, false).rotation_rad, 0.02, 1e-3);
  EXPECT_GT(pose_error(measured, truth, true).rotation_rad, 1.2);
}

TEST(PoseLine, ShowsMillimetresAndDegrees) {
  ReceivedPose received = pose(50);
  received.pose->t = Vector3(0.0015, -0.25, 3.0);
  received.error = PoseError{0.01, 0.002};
  const std::string line = pose_line(received);
  EXPECT_THAT(line, HasSubstr("00:00:01.000 dock -------- ok  t 1.50 -250.00 3000.00 mm"));
  EXPECT_THAT(line, HasSubstr("age 4.0 ms  error 2.00 mm 0.573 deg"));
}

TEST(PoseLine, ShowsNoTurnThatWasNotMeasured) {
  ReceivedPose received = pose(50);
  received.of_camera = true;
  received.pose->R = rotation_exp(Vector3(M_PI, 0, 0)) * rotation_exp(Vector3(0, 0, 0.5));
  EXPECT_THAT(pose_line(received), HasSubstr("gamma 28.65 deg"));
  received.has_turn = false;
  EXPECT_THAT(pose_line(received), HasSubstr("gamma - deg"));
}

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// A message of the Listener tests: a valid pose at a time.
std::vector<std::uint8_t> message_at(std::int64_t utime_us) {
  pose_t message{};
  message.valid = 1;
  message.orientation_wxyz[0] = 1.0;
  message.utime = utime_us;
  return encoded(message);
}

/// The file of true poses: the target is stationary at 1 m until `until_us`.
void write_truth(const std::filesystem::path& path, std::int64_t until_us) {
  std::ofstream(path) << "utime,qw,qx,qy,qz,tx_m,ty_m,tz_m\n0,1,0,0,0,0,0,1\n" << until_us << ",1,0,0,0,0,0,1\n";
}

class ListenerWithTruth : public ::testing::Test {
 protected:
  void SetUp() override { write_truth(path_, 1'000); }
  void TearDown() override { std::filesystem::remove(path_); }

  /// Output for a pose at `utime_us` and, `later_ns` after it, one whose truth is known.
  std::string lines_of(std::int64_t utime_us, std::int64_t later_ns, std::int64_t truth_until_us) {
    Listener listener(ListenFormat::kLines, false, TruthFile(path_.string()));
    ::testing::internal::CaptureStdout();
    const auto take = [&](std::int64_t at_us, std::int64_t monotonic_ns) {
      const auto bytes = message_at(at_us);
      listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, monotonic_ns);
    };
    take(utime_us, 0);
    if (truth_until_us > 0) write_truth_row(truth_until_us);
    take(500, later_ns);
    std::string lines = ::testing::internal::GetCapturedStdout();
    ::testing::internal::CaptureStdout();
    listener.finish();
    ::testing::internal::GetCapturedStdout();
    compared_ = listener.summary().sources().at(0).error.count;
    return lines;
  }
  void write_truth_row(std::int64_t at_us) { std::ofstream(path_, std::ios::app) << at_us << ",1,0,0,0,0,0,1\n"; }

  const std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) / ("listen_truth_" + std::to_string(::getpid()) + ".csv");
  std::int64_t compared_ = 0;
};

TEST_F(ListenerWithTruth, APoseWaitsForItsTruthAndKeepsItsPlace) {
  const std::string lines = lines_of(2'000, 100'000'000, 3'000);
  EXPECT_THAT(lines, ::testing::ContainsRegex("00.002 .*error 1000.00 mm 0.000 deg\n.*00.000 .*error 1000.00 mm"));
  EXPECT_EQ(compared_, 2);
}

TEST_F(ListenerWithTruth, APoseWhoseTruthNeverComesHoldsUpNobodyForLong) {
  EXPECT_EQ(lines_of(2'000, 100'000'000, 0), "");
  const std::string lines = lines_of(2'000, 600'000'000, 0);
  EXPECT_THAT(lines, ::testing::ContainsRegex("00.002 [^\n]*/s  age [^\n]* ms\n.*00.000 .*error"));
  EXPECT_EQ(compared_, 1);
}

TEST(Listener, ShowsARowWherePosesStopAndWhereTheyComeAgain) {
  constexpr std::int64_t kMs = 1'000'000;
  Listener listener(ListenFormat::kLines, false, std::nullopt);
  const auto bytes = message_at(500);
  const auto take = [&](std::int64_t ms) {
    listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, ms * kMs);
  };
  const auto rows = [&](auto&& action) {
    ::testing::internal::CaptureStdout();
    action();
    return ::testing::internal::GetCapturedStdout();
  };
  rows([&] {
    for (std::int64_t ms = 0; ms <= 100; ms += 10) take(ms);
  });
  EXPECT_EQ(rows([&] { listener.tick(0, 400 * kMs); }), "");
  EXPECT_THAT(rows([&] { listener.tick(0, 460 * kMs); }), HasSubstr("-------- LOST  no pose for 0.4 s\n"));
  EXPECT_EQ(rows([&] { listener.tick(0, 900 * kMs); }), "") << "once";
  EXPECT_THAT(rows([&] { take(2'100); }), HasSubstr("FOUND  after 2.0 s\n"));
}

TEST(Listener, ShowsWhereAPanelPoints) {
  pointing_t message{};
  message.utime = 61'000'000;
  message.target = "iss";
  message.status = "ok";
  message.valid = 1;
  message.images = 1;
  message.pitch_rad = 0.5;
  message.yaw_rad = -0.25;
  message.sigma_axis_rad = 0.02;
  const std::vector<std::uint8_t> bytes = encoded(message);
  Listener listener(ListenFormat::kLines, false, std::nullopt);
  ::testing::internal::CaptureStdout();
  listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, 0);
  EXPECT_THAT(::testing::internal::GetCapturedStdout(),
              HasSubstr("00:01:01.000 iss image ok  pitch 28.648 yaw -14.324 deg  sigma 1.146 deg"));
  EXPECT_EQ(listener.passed_over().other_types, 0);
  EXPECT_EQ(listener.other_messages(), 1);
  message.valid = 0;
  message.status = "refused_no_panel";
  EXPECT_THAT(pointing_json(message), HasSubstr("\"pitch_deg\":null"));
}

TEST(Listener, PassesOverWhatItDoesNotKnow) {
  Listener listener(ListenFormat::kNone, false, std::nullopt);
  const char noise[] = "not a message";
  listener.take("C", noise, sizeof noise, 0, 0);
  EXPECT_EQ(listener.passed_over().other_types, 1);
  EXPECT_EQ(listener.summary().poses(), 0);
}

TEST(Listener, PassesOverAPoseThatNoDaemonSends) {
  pose_t message{};
  message.valid = 1;
  message.status = "ok";
  message.orientation_wxyz[0] = std::numeric_limits<double>::quiet_NaN();
  Listener listener(ListenFormat::kLines, false, std::nullopt);
  ::testing::internal::CaptureStdout();
  const std::vector<std::uint8_t> bytes = encoded(message);
  listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, 0);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(listener.passed_over().impossible, 1);
  EXPECT_EQ(listener.summary().poses(), 0);
}

TEST(Listener, ShowsNoEscapeSequencesAndNoLinesOfOthers) {
  status_t status{};
  status.host = "a\x1b[2Jb";
  status.message = "x\n00:00:00.000 dock ok";
  pose_t refusal{};
  refusal.target = "\x1b]0;title\x07";
  refusal.status = "refused\r\n";
  Listener listener(ListenFormat::kLines, false, std::nullopt);
  ::testing::internal::CaptureStdout();
  for (const auto& bytes : {encoded(status), encoded(refusal)}) {
    listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, 0);
  }
  const std::string lines = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2) << lines;
  EXPECT_EQ(lines.find_first_of("\x1b\x07\r"), std::string::npos);
  EXPECT_THAT(summary_text(listener.summary().sources()), Not(HasSubstr("\x1b")));
}

TEST(Listener, ShowsNoEscapeSequencesWherePosesStopAndComeAgain) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  pose_t message{};
  message.valid = 1;
  message.orientation_wxyz[0] = 1.0;
  message.target = "dock\x1b[2J\n";
  const std::vector<std::uint8_t> bytes = encoded(message);
  Listener listener(ListenFormat::kLines, false, std::nullopt);
  ::testing::internal::CaptureStdout();
  const auto take = [&](std::int64_t at_ns) {
    listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, at_ns);
  };
  take(0);
  take(kSecond / 10);
  listener.tick(0, 5 * kSecond);
  take(6 * kSecond);
  const std::string lines = ::testing::internal::GetCapturedStdout();
  EXPECT_THAT(lines, HasSubstr("LOST"));
  EXPECT_THAT(lines, HasSubstr("FOUND"));
  EXPECT_THAT(lines, Not(HasSubstr("\x1b")));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 5) << lines;
}

TEST(Listener, KeepsNoMoreSourcesThanItMay) {
  Listener listener(ListenFormat::kNone, false, std::nullopt);
  pose_t refusal{};
  for (std::size_t k = 0; k < ListenSummary::kMaxStreams + 10; ++k) {
    refusal.source = "lighthouse/" + std::to_string(k);
    const std::vector<std::uint8_t> bytes = encoded(refusal);
    listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 0, 0);
  }
  EXPECT_EQ(listener.summary().sources().size(), ListenSummary::kMaxStreams);
  EXPECT_EQ(listener.passed_over().too_many, 10);
}

TEST(Listener, TakesAgeFromTheMeasurement) {
  const std::vector<std::uint8_t> bytes = message_at(1'000'000);
  Listener listener(ListenFormat::kNone, false, std::nullopt);
  listener.take("C", bytes.data(), static_cast<int>(bytes.size()), 1'002'500'000, 0);
  ASSERT_EQ(listener.summary().poses(), 1);
  EXPECT_EQ(listener.summary().sources()[0].age.max_ns(), 2'500'000);
}

}  // namespace
}  // namespace pharos::tools
