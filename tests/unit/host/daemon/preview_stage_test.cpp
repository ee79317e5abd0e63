// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/preview_stage.hpp"

#include <gtest/gtest.h>

#include <map>

#include "host/images/picture.hpp"
#include "pharos/preview_t.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {
namespace {

AnnotatedImage grey(const std::string& view = "", std::int32_t width = 64) {
  AnnotatedImage image;
  image.view = view;
  image.width_px = width;
  image.height_px = 48;
  image.pixels.assign(static_cast<std::size_t>(width) * 48, 1000);
  return image;
}

class PreviewStageTest : public ::testing::Test {
 protected:
  PreviewStageTest() {
    config.previews = true;
    header.source = "tof/helios";
    header.sensor = "helios";
    header.target = "client";
    header.utc_ns = 1'700'000'000'123'456'789;
  }
  std::vector<preview_t> messages() const { return sink.all<preview_t>("PHAROS_PREVIEW"); }
  void take(std::vector<AnnotatedImage> images) { stage.take(header, std::move(images)); }
  void wait_for(std::size_t count) {
    while (messages().size() < count) loop.turn(20);
  }
  std::int64_t counter(const std::string& name) const {
    for (const NamedCount& count : stage.named_counts()) {
      if (count.name == name) return count.value;
    }
    return -1;
  }

  MessageList sink;
  Publisher publisher{sink, "PHAROS_"};
  EventLoop loop;
  test::ManualClock clock;
  PublishConfig config;
  MeasurementHeader header;
  PreviewStage stage{loop, publisher, config, clock};
};

TEST_F(PreviewStageTest, SendsAPictureWithTheMeasurementsNamesAndTime) {
  header.refusal = "ring_not_found";
  take({grey()});
  wait_for(1);
  const preview_t message = messages()[0];
  EXPECT_EQ(message.utime, 1'700'000'000'123'456);
  EXPECT_EQ(message.source, "tof/helios");
  EXPECT_EQ(message.station_or_camera, "helios");
  EXPECT_EQ(message.view, "");
  EXPECT_EQ(message.target, "client");
  EXPECT_EQ(message.status, "refused_ring_not_found");
  EXPECT_EQ(message.width_px, 64);
  EXPECT_EQ(message.height_px, 48);
  EXPECT_EQ(message.format, "jpeg");
  EXPECT_EQ(decode_picture(message.data, "preview").width_px, 64);
  EXPECT_EQ(counter("published_previews"), 1);
}

TEST_F(PreviewStageTest, SendsNothingUnlessItIsAsked) {
  config.previews = false;
  EXPECT_FALSE(stage.due("tof/helios"));
  take({grey()});
  for (int k = 0; k < 10; ++k) loop.turn(5);
  EXPECT_TRUE(messages().empty());
  config.previews = true;  // as SIGHUP does
  EXPECT_TRUE(stage.due("tof/helios"));
  take({grey()});
  wait_for(1);
}

TEST_F(PreviewStageTest, TakesTwoASecondOfEachSource) {
  std::size_t sent = 0;
  for (int k = 0; k < 300; ++k) {  // ten seconds at 30 frames/s
    const bool due = stage.due("tof/helios");
    take({grey()});
    if (due) wait_for(++sent);
    clock.advance(33'333'334);
  }
  EXPECT_EQ(sent, 20u);
  header.source = "tof/other";
  EXPECT_TRUE(stage.due("tof/other")) << "the other source's pictures do not count";
  take({grey()});
  wait_for(21);
  for (int k = 0; k < 10; ++k) loop.turn(5);
  EXPECT_EQ(messages().size(), 21u);
}

TEST_F(PreviewStageTest, ViewsAreNumberedByThemselves) {
  for (int k = 0; k < 3; ++k) {
    take({grey("left"), grey("right")});
    clock.advance(PreviewStage::kPeriod_ns);
  }
  wait_for(6);
  std::map<std::string, std::int64_t> next;
  for (const preview_t& message : messages()) EXPECT_EQ(message.sequence, next[message.view]++);
  EXPECT_EQ(next["left"], 3);
  EXPECT_EQ(next["right"], 3);
}

TEST_F(PreviewStageTest, EveryPictureIsSentDroppedOrFailed) {
  std::vector<AnnotatedImage> many(40, grey("", 2000));
  many.back() = AnnotatedImage{};  // nothing to encode; the newest, so that it is not dropped
  take(std::move(many));
  const auto done = [this] {
    return counter("published_previews") + counter("previews_dropped") + counter("previews_failed");
  };
  while (done() < 40) loop.turn(20);
  EXPECT_EQ(done(), 40);
  EXPECT_EQ(counter("previews_failed"), 1);
  EXPECT_GE(messages().size(), PreviewStage::kMaxWaiting - 1);
}

}  // namespace
}  // namespace pharos::host
