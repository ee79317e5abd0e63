// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publisher.hpp"

#include <gtest/gtest.h>

#include "host/publish/lcm_sink.hpp"
#include "pharos/bearings_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/status_t.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {
namespace {

TEST(Publisher, SendsEachKindOnItsChannelBehindThePrefix) {
  MessageList list;
  Publisher publisher(list, "TEST_");
  CycleReport report;
  report.target = "dock";
  EXPECT_TRUE(publisher.publish_pose(report));
  EXPECT_TRUE(publisher.publish_board_pose(report));
  EXPECT_TRUE(publisher.publish_bearings(report));
  EXPECT_TRUE(publisher.publish_health({}));
  EXPECT_EQ(list.all<pose_t>("TEST_LIGHTHOUSE_POSE").size(), 1u);
  EXPECT_EQ(list.all<pose_t>("TEST_LIGHTHOUSE_BOARD_POSE").size(), 1u);
  EXPECT_EQ(list.all<bearings_t>("TEST_LIGHTHOUSE_BEARINGS").size(), 1u);
  EXPECT_EQ(list.all<status_t>("TEST_STATUS").size(), 1u);
  EXPECT_EQ(publisher.counters().poses, 2);
  EXPECT_GT(publisher.counters().bytes, 0);
}

TEST(Publisher, CountsWhatCouldNotBeSent) {
  MessageList list;
  list.broken = true;
  Publisher publisher(list, "");
  EXPECT_FALSE(publisher.publish_pose(CycleReport{}));
  EXPECT_EQ(publisher.counters().failed, 1);
  EXPECT_EQ(publisher.counters().poses, 0);
  EXPECT_EQ(publisher.counters().bytes, 0);
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
  EXPECT_TRUE(Publisher(sink, "PHAROS_").publish_pose(CycleReport{}));
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
