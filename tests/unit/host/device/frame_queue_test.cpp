// SPDX-License-Identifier: Apache-2.0
#include "host/device/frame_queue.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <thread>

namespace pharos::host {
namespace {

bool readable(const FrameQueue& queue, int timeout_ms = 0) {
  pollfd waiting{queue.fd(), POLLIN, 0};
  return ::poll(&waiting, 1, timeout_ms) == 1;
}

DepthFramePtr numbered(FrameQueue& queue, std::int64_t number) {
  DepthFramePtr frame = queue.blank();
  frame->camera_ns = number;
  return frame;
}

TEST(FrameQueue, IsReadableExactlyWhileFramesWait) {
  FrameQueue queue;
  EXPECT_FALSE(readable(queue));
  EXPECT_EQ(queue.take(), nullptr);
  queue.push(numbered(queue, 1));
  queue.push(numbered(queue, 2));
  EXPECT_TRUE(readable(queue));
  EXPECT_EQ(queue.take()->camera_ns, 1) << "in order";
  EXPECT_TRUE(readable(queue));
  EXPECT_EQ(queue.take()->camera_ns, 2);
  EXPECT_FALSE(readable(queue));
}

TEST(FrameQueue, DropsTheOldestForTheNewestAndSaysSo) {
  FrameQueue queue;
  int dropped = 0;
  for (int i = 0; i < 10; ++i) dropped += queue.push(numbered(queue, i)) ? 1 : 0;
  EXPECT_EQ(dropped, 10 - static_cast<int>(FrameQueue::kMaxWaiting));
  EXPECT_EQ(queue.take()->camera_ns, 8);
  EXPECT_EQ(queue.take()->camera_ns, 9);
  EXPECT_EQ(queue.take(), nullptr);
}

TEST(FrameQueue, FramesGoRoundWithTheirMemory) {
  FrameQueue queue;
  DepthFramePtr frame = queue.blank();
  frame->resize(640, 480);
  const std::uint16_t* const pixels = frame->depth.data();
  queue.push(std::move(frame));
  queue.recycle(queue.take());
  DepthFramePtr again = queue.blank();
  again->resize(640, 480);
  EXPECT_EQ(again->depth.data(), pixels);
}

TEST(FrameQueue, WakesTheLoopFromAnotherThreadAndLosesNothingUncounted) {
  FrameQueue queue;
  constexpr int kFrames = 2000;
  int dropped = 0;
  std::thread camera([&] {
    for (int i = 1; i <= kFrames; ++i) dropped += queue.push(numbered(queue, i)) ? 1 : 0;
  });
  int taken = 0;
  std::int64_t last = 0;
  while (last < kFrames) {
    ASSERT_TRUE(readable(queue, 10'000));
    DepthFramePtr frame = queue.take();
    ASSERT_NE(frame, nullptr);
    EXPECT_GT(frame->camera_ns, last);
    last = frame->camera_ns;
    ++taken;
    queue.recycle(std::move(frame));
  }
  camera.join();
  EXPECT_EQ(taken + dropped, kFrames);
}

}  // namespace
}  // namespace pharos::host
