// SPDX-License-Identifier: Apache-2.0
#include "host/camera_link/frame_slots.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>

namespace pharos::host {
namespace {

constexpr SlotLayout kLayout{40, 30, true};

std::uint64_t write(FrameSlotWriter& writer, std::uint16_t value) {
  const FrameImages images = writer.begin();
  std::fill(images.depth.begin(), images.depth.end(), value);
  std::fill(images.intensity.begin(), images.intensity.end(), static_cast<std::uint16_t>(value + 1));
  return writer.publish();
}

bool holds(const DepthFrame& frame, std::uint16_t value) {
  return std::count(frame.depth.begin(), frame.depth.end(), value) == 1200 &&
         std::count(frame.intensity.begin(), frame.intensity.end(), value + 1) == 1200;
}

TEST(FrameSlots, AFrameComesThroughWhole) {
  FrameSlotReader reader(kLayout);
  FrameSlotWriter writer(reader.fd(), kLayout);
  DepthFrame frame;
  for (std::uint16_t value = 100; value < 120; ++value) {
    ASSERT_TRUE(reader.copy(write(writer, value), frame));
    EXPECT_TRUE(holds(frame, value));
  }
}

TEST(FrameSlots, AGreyFrameHasNoDepth) {
  constexpr SlotLayout kGrey{40, 30, false};
  FrameSlotReader reader(kGrey);
  FrameSlotWriter writer(reader.fd(), kGrey);
  EXPECT_TRUE(writer.begin().depth.empty());
  DepthFrame frame;
  EXPECT_TRUE(reader.copy(writer.publish(), frame));
  EXPECT_TRUE(frame.depth.empty());
  EXPECT_EQ(frame.intensity.size(), 1200U);
}

TEST(FrameSlots, WhatWasOverwrittenOrIsBeingWrittenIsNoFrame) {
  FrameSlotReader reader(kLayout);
  FrameSlotWriter writer(reader.fd(), kLayout);
  DepthFrame frame;
  EXPECT_FALSE(reader.copy(0, frame));
  EXPECT_FALSE(reader.copy(1, frame)) << "none was written yet";
  const std::uint64_t first = write(writer, 1);
  for (std::uint64_t i = 1; i < SlotLayout::kSlots; ++i) write(writer, 2);
  EXPECT_TRUE(reader.copy(first, frame));
  writer.begin();
  EXPECT_FALSE(reader.copy(first, frame)) << "its slot is being written";
  writer.publish();
  EXPECT_FALSE(reader.copy(first, frame)) << "its slot holds another";
  EXPECT_FALSE(reader.copy(first + 100, frame));
}

// A writer that does not wait for anybody, as the camera's process: what is taken is whole, or it is not taken.
TEST(FrameSlots, NoFrameIsTornUnderAWriterThatGoesOn) {
  FrameSlotReader reader(kLayout);
  std::atomic<std::uint64_t> newest{0};
  std::atomic<bool> stop{false};
  std::thread camera([&] {
    FrameSlotWriter writer(reader.fd(), kLayout);
    while (!stop) newest = write(writer, static_cast<std::uint16_t>((newest + 1) % 60'000));
  });
  DepthFrame frame;
  int taken = 0;
  while (taken < 2000) {
    const std::uint64_t sequence = newest;
    if (!reader.copy(sequence, frame)) continue;
    ++taken;
    ASSERT_TRUE(holds(frame, static_cast<std::uint16_t>(sequence % 60'000)));
  }
  stop = true;
  camera.join();
}

TEST(FrameSlots, WhoHoldsTheMemoryCannotTakeItFromUnderTheReader) {
  FrameSlotReader reader(kLayout);
  EXPECT_NE(::ftruncate(reader.fd(), 0), 0);
  EXPECT_NE(::ftruncate(reader.fd(), 1 << 24), 0);
  EXPECT_NE(::fcntl(reader.fd(), F_ADD_SEALS, F_SEAL_WRITE), 0);
}

TEST(FrameSlots, AWriterRefusesMemoryThatIsTooSmall) {
  FrameSlotReader reader(kLayout);
  EXPECT_THROW(FrameSlotWriter(reader.fd(), SlotLayout{400, 300, true}), std::system_error);
}

}  // namespace
}  // namespace pharos::host
