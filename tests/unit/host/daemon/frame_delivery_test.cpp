// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/frame_delivery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/daemon/source_changes.hpp"
#include "unit/host/daemon/captured_log.hpp"

namespace pharos::host {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kFrame_ns = kNsPerSecond / 30;

/// Ten frames each third of a second; of each ten `lost` are lost, and of those that come `refused` have no pose.
std::int64_t play(FrameDelivery& delivery, int lost, int refused, int seconds, std::int64_t begin_ns = 0) {
  static DeliveredFrames total;
  if (begin_ns == 0) total = {};
  for (std::int64_t i = 0; i < 30 * seconds; ++i) {
    const std::int64_t now_ns = begin_ns + i * kFrame_ns;
    const bool came = i % 10 >= lost;
    ++(came ? total.came : total.lost);
    delivery.on_frames(total, now_ns);
    if (came) delivery.on_answer(i % 10 >= lost + refused, now_ns);
  }
  return begin_ns + seconds * kNsPerSecond;
}

TEST(FrameDelivery, TellsWhatPartOfTheFramesCame) {
  FrameDelivery delivery("frames", "look at the network");
  EXPECT_EQ(delivery.assess(play(delivery, 0, 0, 12)).state, SourceState::kOk);
  const std::int64_t degraded_ns = play(delivery, 2, 0, 12, 12 * kNsPerSecond);
  EXPECT_EQ(delivery.assess(degraded_ns).state, SourceState::kDegraded);
  EXPECT_THAT(delivery.assess(degraded_ns).message,
              HasSubstr("80 % of the expected frames came in the last 10 s; look at the network"));
  EXPECT_EQ(delivery.assess(play(delivery, 6, 0, 12, degraded_ns)).state, SourceState::kError);
}

TEST(FrameDelivery, TellsWhatPartOfThePosesCame) {
  FrameDelivery delivery("frames", "");
  const DeliveryAssessment assessed = delivery.assess(play(delivery, 0, 3, 12));
  EXPECT_EQ(assessed.state, SourceState::kDegraded);
  EXPECT_THAT(assessed.message, HasSubstr("70 % of the expected poses"));
}

TEST(FrameDelivery, ToldOfTenSecondsAndOfFramesEnough) {
  FrameDelivery delivery("frames", "");
  EXPECT_EQ(delivery.assess(play(delivery, 6, 0, 9)).state, SourceState::kOk) << "nine seconds";
  FrameDelivery slow("images", "");
  for (std::int64_t s = 0; s < 60; s += 3) slow.on_answer(false, s * kNsPerSecond);
  EXPECT_EQ(slow.assess(60 * kNsPerSecond).state, SourceState::kOk) << "three images in ten seconds";
}

/// A source that gives a pose each `interval_ns`, asked ten times a second as the daemon does.
struct Watched {
  RateMonitor rate;
  SourceChanges changes{kSilence_ns};
  RateLimitedLog log{"helios"};

  bool changed(std::int64_t now_ns) { return changes.update(rate, {}, "no_ring", log, now_ns); }
  void run(std::int64_t interval_ns, int poses) {
    for (std::int64_t i = 0; i < poses; ++i) {
      rate.on_pose(i * interval_ns);
      changed(i * interval_ns);
    }
  }
};

TEST(SourceChanges, TellsWithinHalfASecondThatPosesStopped) {
  for (const double rate_hz : {7.0, 10.0, 30.0, 120.0}) {
    test::CapturedLog log;
    Watched source;
    const auto interval_ns = static_cast<std::int64_t>(1e9 / rate_hz);
    source.run(interval_ns, 100);
    EXPECT_EQ(log.lines("FOUND").size(), 1u);
    EXPECT_EQ(log.lines("LOST").size(), 0u);
    constexpr std::int64_t kAttend_ns = 100'000'000;
    std::int64_t waited_ns = 0;
    while (!source.changed(99 * interval_ns + waited_ns)) waited_ns += kAttend_ns;
    EXPECT_LE(waited_ns, 500'000'000) << rate_hz;
    EXPECT_EQ(log.lines("LOST: no pose for").size(), 1u);
    EXPECT_EQ(log.lines("(last refusal: no_ring)").size(), 1u);
  }
}

TEST(SourceChanges, ASlowSourceIsNotLostBetweenItsPoses) {
  test::CapturedLog log;
  Watched source;
  source.run(5 * kNsPerSecond, 20);
  EXPECT_EQ(log.lines("LOST").size(), 0u);
  EXPECT_FALSE(source.changed(99 * kNsPerSecond + 4 * kNsPerSecond));
}

}  // namespace
}  // namespace pharos::host
