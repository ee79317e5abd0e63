// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "host/publish/messages.hpp"
#include "host/publish/words.hpp"
#include "pharos/pose/solve.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {
namespace {

CycleReport answered() {
  CycleReport report;
  report.utc_ns = 1'700'000'000'123'456'789;
  report.utc_sigma_ns = 12'000;
  report.age_ns = 1'500'000;
  report.sequence = 41;
  report.source = "lighthouse/pharosd";
  report.target = "dock";
  report.sensor = station_id_text(0xBEC08E38);
  report.station = 1;
  report.flags = flag_words(track::kEpochOutliers | track::kEpochUncalibrated);
  report.observations = 14;
  LighthousePoseEstimate estimate;
  estimate.pose.R = rotation_exp(Vector3(0.1, -2.9, 0.4));  // beyond pi/2, so that the sign of w matters
  estimate.pose.t = Vector3(0.1, -0.2, 3.0);
  for (int i = 0; i < 36; ++i) estimate.covariance(i / 6, i % 6) = i + 1.0;
  estimate.residual_rms = 4e-5;
  estimate.observations = 14;
  estimate.iterations = 4;
  estimate.adop_deg_per_rad = 900.0;
  estimate.pdop_m_per_rad = 70.0;
  report.pose = estimate;
  return report;
}

TEST(PoseMessage, ReportsThePoseInTheDocumentedFramesAndUnits) {
  const CycleReport report = answered();
  const pose_t message = message_of(report);
  EXPECT_EQ(message.utime, 1'700'000'000'123'456);
  EXPECT_EQ(message.utime_sigma_us, 12);
  EXPECT_EQ(message.latency_us, 1500);
  EXPECT_EQ(message.sequence, 41);
  EXPECT_EQ(message.target, "dock");
  EXPECT_EQ(message.station_or_camera, "BEC08E38");
  EXPECT_EQ(message.station, 1);
  EXPECT_EQ(message.status, "ok");
  EXPECT_TRUE(message.valid);
  EXPECT_EQ(message.flags, "uncalibrated|outliers");
  EXPECT_EQ(message.parent_frame, "lighthouse");
  EXPECT_EQ(message.child_frame, "body");
  // The quaternion rotates a vector as the matrix does, and is the one with w >= 0.
  const Quaternion q(message.orientation_wxyz[0], message.orientation_wxyz[1], message.orientation_wxyz[2],
                     message.orientation_wxyz[3]);
  EXPECT_GE(q.w(), 0.0);
  EXPECT_LT((q.toRotationMatrix() - report.pose.pose.R).norm(), 1e-12);
  EXPECT_EQ(Vector3(message.position_m[0], message.position_m[1], message.position_m[2]), report.pose.pose.t);
  EXPECT_EQ(message.covariance[6 * 1 + 2], report.pose.covariance(1, 2));
  EXPECT_EQ(message.covariance[6 * 5 + 0], report.pose.covariance(5, 0));
  EXPECT_DOUBLE_EQ(message.sigma_rot_rad, std::sqrt(1.0 + 8.0 + 15.0));
  EXPECT_DOUBLE_EQ(message.sigma_pos_m, std::sqrt(22.0 + 29.0 + 36.0));
  EXPECT_FALSE(message.has_second);
}

TEST(PoseMessage, AnAmbiguousPoseHasItsSecondSolution) {
  CycleReport report = answered();
  report.ambiguous = true;
  report.pose.second = SecondSolution<frame::Lighthouse, frame::Body>{{Matrix3::Identity(), Vector3(1, 2, 3)}, 3.5};
  const pose_t message = message_of(report);
  EXPECT_EQ(message.status, "ambiguous");
  EXPECT_TRUE(message.valid);
  EXPECT_TRUE(message.has_second);
  EXPECT_EQ(message.second_position_m[2], 3.0);
  EXPECT_EQ(message.second_orientation_wxyz[0], 1.0);
  EXPECT_EQ(message.second_delta_chi2, 3.5);
}

TEST(PoseMessage, ARefusedCycleHasAReasonAndNoPose) {
  CycleReport report = answered();
  report.refusal = pose::name_of(pose::Refusal::kTooFewSensors);
  report.observations = 5;
  const pose_t message = message_of(report);
  EXPECT_EQ(message.status, std::string("refused_") + pose::name_of(pose::Refusal::kTooFewSensors));
  EXPECT_FALSE(message.valid);
  EXPECT_EQ(message.observations, 5);
  for (const double value : message.orientation_wxyz)
    EXPECT_EQ(value, 0.0);  // not a valid rotation, so that it cannot be mistaken for one
  for (const double value : message.position_m) EXPECT_EQ(value, 0.0);
  for (const double value : message.covariance) EXPECT_EQ(value, 0.0);
}

TEST(PoseMessage, BearingsCarryTheirOwnInstants) {
  BearingsReport report;
  report.sequence = 41;
  report.bearings.push_back({7, Axis::kY, 250, -4'000'000, 1.5, 1.51, true, -2e-5});
  const bearings_t message = message_of(report);
  ASSERT_EQ(message.count, 1);
  EXPECT_EQ(message.sequence, 41);
  EXPECT_FALSE(message.calibrated);
  EXPECT_EQ(message.bearings[0].sensor, 7);
  EXPECT_EQ(message.bearings[0].axis, 1);
  EXPECT_EQ(message.bearings[0].offset_ns, -4'000'000);
  EXPECT_EQ(message.bearings[0].raw_theta_rad, 1.5);
  EXPECT_EQ(message.bearings[0].ideal_theta_rad, 1.51);
  EXPECT_TRUE(message.bearings[0].used);
  EXPECT_EQ(message.bearings[0].residual_rad, -2e-5);
}

TEST(PoseMessage, TimesBeforeTheEpochRoundDownToo) {
  CycleReport report = answered();
  report.utc_ns = -1;
  EXPECT_EQ(message_of(report).utime, -1);
}

TEST(Words, EveryFlagHasItsWord) {
  EXPECT_EQ(flag_words(0), "");
  EXPECT_EQ(flag_words(0x7F), "uncalibrated|flash_weak|period_nominal|outliers|prior|lock_poor|residual_high");
}

}  // namespace
}  // namespace pharos::host
