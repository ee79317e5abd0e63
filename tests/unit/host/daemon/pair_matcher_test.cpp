// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/pair_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "host/daemon/stereo/camera_pairs.hpp"
#include "host/support/ready_event.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kWindow = 5 * kMillisecond_ns;

class PairMatcherTest : public ::testing::Test {
 protected:
  /// Times of the left and right frame of the pair that this frame completes, ms.
  std::optional<std::pair<std::int64_t, std::int64_t>> push(std::size_t side, std::int64_t ms) {
    return push_ns(side, ms * kMillisecond_ns);
  }
  std::optional<std::pair<std::int64_t, std::int64_t>> push_ns(std::size_t side, std::int64_t ns) {
    auto pair = matcher.push(side, {std::make_unique<DepthFrame>(), MappedTime{ns, ns, 0}});
    if (!pair) return std::nullopt;
    return std::pair((*pair)[0].time.utc_ns / kMillisecond_ns, (*pair)[1].time.utc_ns / kMillisecond_ns);
  }

  std::array<int, 2> discarded{};
  PairMatcher matcher{kWindow, [this](std::size_t side, DepthFramePtr frame) {
                        EXPECT_TRUE(frame);
                        ++discarded[side];
                      }};
};

using Times = std::pair<std::int64_t, std::int64_t>;

TEST_F(PairMatcherTest, PairsWithinTheWindowWhicheverComesFirst) {
  EXPECT_FALSE(push(0, 0));
  EXPECT_EQ(push(1, 2), Times(0, 2));
  EXPECT_FALSE(push(1, 51));
  EXPECT_EQ(push(0, 50), Times(50, 51));
  EXPECT_FALSE(push(0, 100));
  EXPECT_FALSE(push(1, 106)) << "beyond the window";
  EXPECT_EQ(matcher.unpaired(0), 1);
  EXPECT_EQ(push(0, 104), Times(104, 106));
  EXPECT_EQ(matcher.unpaired(1), 0);
}

TEST_F(PairMatcherTest, TakesTheNearestOfSeveralAndGivesTheOlderUp) {
  push(0, 0);
  push(0, 3);
  push(0, 6);
  EXPECT_EQ(push(1, 4), Times(3, 4));
  EXPECT_EQ(matcher.unpaired(0), 1);
  EXPECT_EQ(push(1, 7), Times(6, 7)) << "the later one still waited";
}

TEST_F(PairMatcherTest, ACameraThatLagsBehindLosesNothing) {
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(push(0, 50 * k));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(push(1, 50 * k + 1), Times(50 * k, 50 * k + 1));
  EXPECT_EQ(discarded[0] + discarded[1], 0);
}

TEST_F(PairMatcherTest, WithoutTheOtherCameraAFewWaitAndTheRestIsCounted) {
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(push(0, 50 * k));
  EXPECT_EQ(matcher.unpaired(0), 100 - static_cast<std::int64_t>(PairMatcher::kMaxWaiting));
  EXPECT_EQ(push(1, 50 * 99), Times(50 * 99, 50 * 99)) << "back again";
  EXPECT_EQ(matcher.unpaired(0), 99);
  EXPECT_EQ(discarded[0], 99) << "every buffer goes back";
}

TEST_F(PairMatcherTest, NeitherLosesNorMakesUpFramesWhateverTheTimes) {
  std::mt19937_64 random(3);
  std::array<std::int64_t, 2> now{};
  std::int64_t pushed = 0, paired = 0, last = -1;
  for (int k = 0; k < 20'000; ++k) {
    // Mostly the camera that lags behind, so that the two stay together on average.
    const std::size_t behind = now[0] <= now[1] ? 0 : 1;
    const std::size_t side = random() % 4 == 0 ? 1 - behind : behind;
    now[side] += static_cast<std::int64_t>(random() % 8'000'000);
    ++pushed;
    const auto pair = push_ns(side, now[side]);
    if (!pair) continue;
    paired += 2;
    EXPECT_LE(std::abs(pair->first - pair->second), kWindow / kMillisecond_ns + 1);
    EXPECT_GE(pair->first, last) << "pairs go forwards";
    last = pair->first;
  }
  matcher.clear();
  EXPECT_EQ(pushed, paired + discarded[0] + discarded[1]);
  EXPECT_EQ(matcher.unpaired(0), discarded[0]);
  EXPECT_GT(paired, 1000);
}

/// A test camera that returns the frames it was given, with times of this computer's clock.
class HandCamera : public FrameSource {
 public:
  int fd() const override { return ready.fd(); }
  DepthFramePtr take() override {
    if (waiting.empty()) return nullptr;
    DepthFramePtr frame = std::move(waiting.front());
    waiting.pop_front();
    return frame;
  }
  void recycle(DepthFramePtr) override { ++returned; }
  FrameSourceStatus status() const override { return about; }
  std::string device() const override { return "camera " + about.identity; }
  void show(std::int64_t utc_ns) {
    auto frame = std::make_unique<DepthFrame>();
    frame->resize_grey(2, 1);
    frame->clock = CameraClock::kHost;
    frame->camera_ns = frame->arrival_utc_ns = utc_ns;
    frame->arrival_monotonic_ns = frame->complete_monotonic_ns = utc_ns;
    waiting.push_back(std::move(frame));
  }

  ReadyEvent ready;
  std::deque<DepthFramePtr> waiting;
  FrameSourceStatus about;
  int returned = 0;
};

class CameraPairsTest : public ::testing::Test {
 protected:
  CameraPairsTest() {
    for (std::size_t side = 0; side < 2; ++side) {
      auto camera = std::make_unique<HandCamera>();
      hands[side] = camera.get();
      hands[side]->about.state = CameraState::kOpen;
      hands[side]->about.session = 1;
      hands[side]->about.identity = side == 0 ? "L" : "R";
      cameras[side] = std::move(camera);
    }
    pairs.emplace(std::move(cameras), kWindow);
  }
  std::int64_t counter(const std::string& name) const {
    for (const NamedCount& count : pairs->status().counters) {
      if (count.name == name) return count.value;
    }
    return -1;
  }

  CameraPairs::Cameras cameras;
  std::array<HandCamera*, 2> hands{};
  std::optional<CameraPairs> pairs;
};

TEST_F(CameraPairsTest, MakesPairsAndSendsTheBuffersRound) {
  const std::int64_t t = 1'000'000 * kMillisecond_ns;
  hands[0]->show(t);
  hands[1]->show(t + 2 * kMillisecond_ns);
  StereoPairPtr pair = pairs->take();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->time.utc_ns, t + kMillisecond_ns);
  EXPECT_EQ(pair->offset_ns, 2 * kMillisecond_ns);
  EXPECT_EQ(counter("device.pairs"), 1);
  EXPECT_GE(counter("pair_offset_max_us"), 1999);
  pairs->recycle(std::move(pair));
  EXPECT_EQ(hands[0]->returned, 1);
  EXPECT_EQ(hands[1]->returned, 1);
}

TEST_F(CameraPairsTest, TheWorseCameraIsTheOneReported) {
  EXPECT_EQ(pairs->status().state, CameraState::kOpen);
  EXPECT_EQ(pairs->status().identity, "left: L; right: R");
  hands[1]->about.state = CameraState::kGone;
  hands[1]->about.error = "no camera answers";
  EXPECT_EQ(pairs->status().state, CameraState::kGone);
  EXPECT_EQ(pairs->status().error, "right: no camera answers");
  for (int k = 0; k < 20; ++k) {
    hands[0]->show((1'000'000 + 50 * k) * kMillisecond_ns);
    EXPECT_FALSE(pairs->take());
  }
  EXPECT_EQ(counter("left.frames_without_partner"), 16);
}

TEST_F(CameraPairsTest, ShuttersThatAreNotTogetherAreReported) {
  for (int k = 0; k < 12; ++k) {
    EXPECT_EQ(pairs->status().error.empty(), k < 9) << k;
    hands[0]->show((1'000'000 + 50 * k) * kMillisecond_ns);
    hands[1]->show((1'000'020 + 50 * k) * kMillisecond_ns);
    EXPECT_FALSE(pairs->take());
  }
  EXPECT_NE(pairs->status().error.find("pairing_window_ms"), std::string::npos);
  hands[0]->show(2'000'000 * kMillisecond_ns);
  hands[1]->show(2'000'000 * kMillisecond_ns);
  EXPECT_TRUE(pairs->take());
  EXPECT_EQ(pairs->status().error, "") << "over";
}

TEST_F(CameraPairsTest, PairsNeverGoBack) {
  const std::int64_t t = 1'000'000 * kMillisecond_ns;
  for (const std::int64_t at : {t, t - 20 * kMillisecond_ns, t + 20 * kMillisecond_ns}) {
    hands[0]->show(at);
    hands[1]->show(at);
    EXPECT_EQ(pairs->take() != nullptr, at != t - 20 * kMillisecond_ns);
  }
  EXPECT_EQ(counter("device.pairs_time_back"), 1);
}

}  // namespace
}  // namespace pharos::host
