// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>

#include "firmware/rtl/capture_registers.h"
#include "rtl/capture_rig.hpp"

namespace pharos::rtl {
namespace {

TEST(Registers, TellWhatTheBlockIsAndWhatItWasBuiltWith) {
  CaptureRig rig;
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_ID_OFFSET), 0x50484350u);
  const std::uint32_t build = rig.read(PHAROS_CAPTURE_BUILD_OFFSET);
  EXPECT_EQ(build & PHAROS_CAPTURE_BUILD_INPUTS_MASK, rig.build().inputs);
  EXPECT_EQ(1u << ((build & PHAROS_CAPTURE_BUILD_DEPTH_LOG2_MASK) >> PHAROS_CAPTURE_BUILD_DEPTH_LOG2_SHIFT),
            rig.build().depth);
  EXPECT_EQ((build & PHAROS_CAPTURE_BUILD_FILTER_WIDTH_MASK) >> PHAROS_CAPTURE_BUILD_FILTER_WIDTH_SHIFT,
            rig.build().filter_width);
  EXPECT_EQ(build >> PHAROS_CAPTURE_BUILD_VERSION_SHIFT, std::uint32_t{PHAROS_CAPTURE_VERSION});
}

TEST(Registers, StandAtReset) {
  CaptureRig rig;
  const auto expect_reset_values = [&] {
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_CONTROL_OFFSET), 0u);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_THRESHOLD_OFFSET), 0u);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_STATUS_OFFSET), std::uint32_t{PHAROS_CAPTURE_STATUS_GAP_NEXT});
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), 0u);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_TIME_HIGH_OFFSET), 0u);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_INPUT_ENABLE_OFFSET), rig.input_mask());
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_FILTER_OFFSET), 0u);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_GLITCHES_OFFSET), 0u);
  };
  expect_reset_values();
  // And again after everything was in use.
  rig.enable();
  rig.write(PHAROS_CAPTURE_THRESHOLD_OFFSET, 1);
  rig.write(PHAROS_CAPTURE_FILTER_OFFSET, 1);
  rig.write(PHAROS_CAPTURE_INPUT_ENABLE_OFFSET, 0x15);
  for (unsigned i = 0; i < 2 * rig.build().depth; ++i) {
    rig.set_pins(~rig.pins());
    rig.ticks(3);
  }
  rig.reset();
  expect_reset_values();
  EXPECT_TRUE(rig.agrees());
}

TEST(Registers, ReadBackWhatFitsAndIgnoreTheRest) {
  CaptureRig rig;
  for (const std::uint32_t data : {0xFFFFFFFFu, 0u, 0xA5A5A5A5u, 0x5A5A5A5Au}) {
    for (std::uint8_t offset = 0; offset < 64; offset = static_cast<std::uint8_t>(offset + 4)) rig.write(offset, data);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_CONTROL_OFFSET), data & PHAROS_CAPTURE_CONTROL_ENABLE);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_THRESHOLD_OFFSET), data & (2 * rig.build().depth - 1));
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_INPUT_ENABLE_OFFSET), data & rig.input_mask());
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_FILTER_OFFSET), data & ((1u << rig.build().filter_width) - 1));
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_ID_OFFSET), std::uint32_t{PHAROS_CAPTURE_ID});
    EXPECT_EQ(rig.read(0x3C), 0u);
  }
  EXPECT_TRUE(rig.agrees());
}

TEST(Registers, TimeIsReadWholeAcrossTheWrapOfItsLowWord) {
  CaptureRig rig;
  const std::uint64_t wrap = std::uint64_t{7} << 32;
  for (std::uint64_t before = 0; before < 6; ++before) {
    rig.set_ticks(wrap - before);
    const std::uint64_t low = rig.read(PHAROS_CAPTURE_TIME_LOW_OFFSET);
    rig.ticks(4);  // the low word may wrap between the two reads
    const std::uint64_t high = rig.read(PHAROS_CAPTURE_TIME_HIGH_OFFSET);
    EXPECT_EQ(high << 32 | low, wrap - before);
  }
}

TEST(Registers, LevelsFollowThePinsWhetherEnabledOrNot) {
  CaptureRig rig;
  for (const std::uint32_t pins : {0xFFFFFFFFu, 0u, 0x12345678u}) {
    rig.set_pins(pins);
    rig.ticks(PHAROS_CAPTURE_LATENCY_TICKS);
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_LEVELS_OFFSET), pins & rig.input_mask());
  }
}

TEST(Registers, AnEmptyFifoReadsZeroAndGivesNothingUp) {
  CaptureRig rig;
  rig.enable();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(rig.read(PHAROS_CAPTURE_FIFO_LEVELS_OFFSET), 0u);
  rig.set_pins(1);
  rig.ticks(8);
  rig.set_pins(0);
  rig.ticks(8);
  EXPECT_EQ(rig.drain().size(), 2u);  // reads of an empty FIFO had no effect
}

TEST(Registers, InterruptIsHighFromTheThresholdOnAndOnlyThen) {
  CaptureRig rig;
  rig.enable();
  const unsigned threshold = rig.build().depth / 2 + 1;
  rig.write(PHAROS_CAPTURE_THRESHOLD_OFFSET, threshold);
  for (unsigned records = 1; records <= rig.build().depth; ++records) {
    rig.set_pins(~rig.pins());
    rig.ticks(8);
    EXPECT_EQ(rig.interrupt(), records >= threshold) << records;
  }
  for (unsigned records = rig.build().depth; records-- > 0;) {
    rig.read_record();
    rig.ticks(2);
    EXPECT_EQ(rig.interrupt(), records >= threshold) << records;
  }
  rig.write(PHAROS_CAPTURE_THRESHOLD_OFFSET, 0);
  rig.set_pins(~rig.pins());
  rig.ticks(8);
  EXPECT_FALSE(rig.interrupt());
  EXPECT_TRUE(rig.agrees());
}

}  // namespace
}  // namespace pharos::rtl
