// SPDX-License-Identifier: Apache-2.0
// Only finite and fresh reports are sent, and every other one is counted once.
#include "host/publish/publish_gate.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "host/publish/messages.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kMaxAge_ns = 200'000'000;

class PublishGateTest : public ::testing::Test {
 protected:
  template <class Report>
  void expect_kept_back(Report report) {
    const std::int64_t before = not_finite;
    EXPECT_FALSE(gate.publish(report));
    EXPECT_EQ(not_finite, before + 1);
    report.refusal = "lost";
    EXPECT_TRUE(gate.publish(report)) << "a refusal holds no numbers";
  }

  MessageList list;
  Publisher publisher{list, ""};
  std::int64_t not_finite = 0;
  std::int64_t stale = 0;
  PublishGate gate{publisher, not_finite, PublishGate::AgeLimit{kMaxAge_ns, stale}};
};

TEST_F(PublishGateTest, NothingThatIsNotFiniteLeavesOnAnyChannel) {
  CycleReport cycle;
  cycle.pose.covariance(3, 3) = kNan;
  expect_kept_back(cycle);
  BoardPoseReport board;
  board.pose.pose.t.x() = kInfinity;
  expect_kept_back(board);
  TofReport tof;
  tof.pose.pose.R(1, 1) = kNan;
  expect_kept_back(tof);
  Ring2PoseEstimate ring;
  ring.second = {{}, kNan};
  expect_kept_back(StereoReport(ring));
  SlamPoseEstimate slam;
  slam.residual_rms = kInfinity;
  expect_kept_back(StereoReport(slam));
  SpinReport spin;
  spin.spin.rate_rad_s.y() = kNan;
  expect_kept_back(spin);
  PointingReport pointing;
  pointing.axis_earth.z() = kNan;
  expect_kept_back(pointing);
  BearingsReport bearings;
  bearings.bearings.resize(2);
  bearings.bearings[1].ideal_theta_rad = kNan;
  expect_kept_back(bearings);
  EXPECT_EQ(list.entries.size(), 8u) << "the refusals alone";
}

TEST_F(PublishGateTest, WhatIsTooOldOrFromTheFutureIsCountedAndNotSent) {
  for (const std::int64_t age_ns : {kMaxAge_ns + 1, -kMaxAge_ns - 1}) {
    TofReport report;
    report.age_ns = age_ns;
    EXPECT_FALSE(gate.publish(report));
    report.refusal = "no_ring_plane";
    EXPECT_FALSE(gate.publish(report)) << "a refusal is news about now";
  }
  EXPECT_EQ(stale, 4);
  for (const std::int64_t age_ns : {kMaxAge_ns, -kMaxAge_ns}) {
    TofReport report;
    report.age_ns = age_ns;
    EXPECT_TRUE(gate.publish(report));
  }
  EXPECT_EQ(list.entries.size(), 2u);
}

TEST_F(PublishGateTest, WithoutAnAgeLimitNothingIsTooOld) {
  PublishGate files(publisher, not_finite);
  PointingReport report;
  report.age_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(files.publish(report));
  EXPECT_EQ(stale, 0);
}

TEST_F(PublishGateTest, NumbersWhatLeavesAndNothingElse) {
  for (int i = 0; i < 4; ++i) {
    TofReport report;
    report.age_ns = i == 1 ? kMaxAge_ns + 1 : 0;
    if (i == 2) report.pose.pose.t.x() = kNan;
    gate.publish(report);
  }
  const auto poses = list.all<pose_t>("TOF_POSE");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].sequence, 0);
  EXPECT_EQ(poses[1].sequence, 1);
}

TEST_F(PublishGateTest, ACompanionSharesTheNumberOfWhatItBelongsTo) {
  for (int i = 0; i < 3; ++i) {
    CycleReport cycle;
    BearingsReport bearings;
    EXPECT_TRUE(gate.publish(cycle));
    EXPECT_TRUE(gate.publish_companion(bearings));
    EXPECT_EQ(bearings.sequence, cycle.sequence);
    EXPECT_EQ(bearings.sequence, i);
  }
}

TEST_F(PublishGateTest, ANumberIsGivenAlsoWhereTheNetworkFails) {
  TofReport first, second;
  list.broken = true;
  EXPECT_FALSE(gate.publish(first));
  list.broken = false;
  EXPECT_TRUE(gate.publish(second));
  EXPECT_EQ(second.sequence, 1) << "a gap is a loss on the network";
  EXPECT_EQ(publisher.counters().failed, 1);
}

}  // namespace
}  // namespace pharos::host
