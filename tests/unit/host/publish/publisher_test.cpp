// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publisher.hpp"

#include <gtest/gtest.h>

#include "host/publish/lcm_sink.hpp"
#include "host/publish/messages.hpp"
#include "host/publish/publish_gate.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {
namespace {

/// A gate with its counters, as used by a pipeline.
struct Gate {
  explicit Gate(MessageSink& sink, const std::string& prefix = "TEST_") : publisher(sink, prefix) {}

  Publisher publisher;
  std::int64_t not_finite = 0;
  PublishGate gate{publisher, not_finite};
};

TEST(Publisher, SendsEachKindOnItsChannelBehindThePrefix) {
  MessageList list;
  Gate out(list);
  CycleReport cycle;
  BoardPoseReport board;
  BearingsReport bearings;
  TofReport tof;
  StereoReport ring2(Ring2PoseEstimate{}), slam(SlamPoseEstimate{});
  PointingReport pointing;
  EXPECT_TRUE(out.gate.publish(cycle));
  EXPECT_TRUE(out.gate.publish(board));
  EXPECT_TRUE(out.gate.publish(bearings));
  EXPECT_TRUE(out.gate.publish(tof));
  EXPECT_TRUE(out.gate.publish(ring2));
  EXPECT_TRUE(out.gate.publish(slam));
  EXPECT_TRUE(out.gate.publish(pointing));
  EXPECT_TRUE(out.publisher.publish_health({}));
  for (const char* channel : {"LIGHTHOUSE_POSE", "LIGHTHOUSE_BOARD_POSE", "TOF_POSE", "RING2_POSE", "SLAM_POSE"}) {
    EXPECT_EQ(list.all<pose_t>(std::string("TEST_") + channel).size(), 1u) << channel;
  }
  EXPECT_EQ(list.all<bearings_t>("TEST_LIGHTHOUSE_BEARINGS").size(), 1u);
  EXPECT_EQ(list.all<pointing_t>("TEST_LINE_POINTING").size(), 1u);
  EXPECT_EQ(list.all<status_t>("TEST_STATUS").size(), 1u);
  EXPECT_EQ(out.publisher.counters().poses, 5);
  EXPECT_EQ(out.publisher.counters().bearings, 1);
  EXPECT_EQ(out.publisher.counters().pointings, 1);
  EXPECT_GT(out.publisher.counters().bytes, 0);
}

TEST(Publisher, ASpinIsSentWithItsCovarianceAndARefusedOneWithNothing) {
  MessageList list;
  Gate out(list);
  SpinReport report;
  report.utc_ns = 7'000'900;
  report.source = "slam/bow";
  report.frames = {"camera", "target"};
  report.sensor = "bow";
  report.target = "client";
  report.spin = {{0.0, -0.2, 0.1}, 1e-6 * Matrix3::Identity(), {0.0, -0.8, 0.6}, 1e-3, 2e-3, 3e-4, 50, 2.5};
  report.spin.covariance(0, 2) = report.spin.covariance(2, 0) = 2e-7;
  EXPECT_TRUE(out.gate.publish(report));
  report.refusal = "lost";
  EXPECT_TRUE(out.gate.publish(report));
  const auto messages = list.all<spin_t>("TEST_SLAM_SPIN");
  ASSERT_EQ(messages.size(), 2u);
  const spin_t &told = messages[0], &refused = messages[1];
  EXPECT_EQ(told.utime, 7000);
  EXPECT_EQ(told.sequence, 0);
  EXPECT_EQ(refused.sequence, 1);
  EXPECT_EQ(told.source + told.station_or_camera + told.target, "slam/bowbowclient");
  EXPECT_EQ(told.reference_frame, "camera");
  EXPECT_EQ(told.status, "ok");
  EXPECT_EQ(told.valid, 1);
  EXPECT_EQ(Vector3(told.rate_rad_s), report.spin.rate_rad_s);
  EXPECT_EQ(Vector3(told.axis), report.spin.axis);
  EXPECT_EQ(told.covariance[2], 2e-7);
  EXPECT_EQ(told.covariance[6], 2e-7);
  EXPECT_EQ(told.covariance[4], 1e-6);
  EXPECT_EQ(told.attitudes, 50);
  EXPECT_EQ(told.span_s, 2.5);
  EXPECT_EQ(refused.status, "refused_lost");
  EXPECT_EQ(refused.valid, 0);
  EXPECT_EQ(Vector3(refused.rate_rad_s), Vector3::Zero());
  EXPECT_EQ(out.publisher.counters().spins, 2);
}

TEST(Publisher, CountsWhatCouldNotBeSent) {
  MessageList list;
  list.broken = true;
  Gate out(list);
  CycleReport report;
  EXPECT_FALSE(out.gate.publish(report));
  EXPECT_EQ(out.publisher.counters().failed, 1);
  EXPECT_EQ(out.publisher.counters().poses, 0);
  EXPECT_EQ(out.publisher.counters().bytes, 0);
}

TEST(Publisher, StatusMessagesAreNumbered) {
  MessageList list;
  Publisher publisher(list, "");
  publisher.publish_health({});
  publisher.publish_health({});
  const auto messages = list.all<status_t>("STATUS");
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[1].sequence - messages[0].sequence, 1);
}

TEST(LcmSink, SendsInsideOneProcess) {
  LcmSink sink("memq://");
  EXPECT_TRUE(Publisher(sink, "PHAROS_").publish_health({}));
}

TEST(LcmSink, SaysWhatToDoWhenLcmCannotBeSetUp) {
  try {
    LcmSink sink("nowhere://");
    FAIL() << "an unknown provider was taken";
  } catch (const LcmError& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere://"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("ip route add"), std::string::npos);
  }
}

}  // namespace
}  // namespace pharos::host
