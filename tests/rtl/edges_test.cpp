// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "firmware/rtl/capture_registers.h"
#include "rtl/capture_rig.hpp"

namespace pharos::rtl {
namespace {

constexpr unsigned kSettle = PHAROS_CAPTURE_LATENCY_TICKS + PHAROS_CAPTURE_VISIBLE_AFTER_TICKS;

// The tick in which the pins change to `pins`, truncated to the 32 bits of a stamp.
std::uint32_t change(CaptureRig& rig, std::uint32_t pins) {
  const auto tick = static_cast<std::uint32_t>(rig.ticks());
  rig.set_pins(pins);
  rig.tick();
  return tick;
}

TEST(Edges, OfEveryInputAreStampedWithTheTickOfTheirPin) {
  CaptureRig rig;
  rig.enable();
  for (unsigned input = 0; input < rig.build().inputs; ++input) {
    const std::uint32_t bit = 1u << input;
    for (const std::uint32_t level : {bit, 0u}) {
      const std::uint32_t tick = change(rig, level);
      rig.ticks(kSettle + input);
      const auto records = rig.drain();
      ASSERT_EQ(records.size(), 1u);
      EXPECT_EQ(records[0].stamp - PHAROS_CAPTURE_LATENCY_TICKS, tick);
      EXPECT_EQ(records[0].changed, bit);
      EXPECT_EQ(records[0].levels, level);
    }
  }
}

TEST(Edges, OfOneTickShareOneRecord) {
  CaptureRig rig;
  rig.enable();
  const std::uint32_t all = rig.input_mask();
  const std::uint32_t lit = change(rig, all);
  rig.ticks(kSettle);
  auto records = rig.drain();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].changed, all);
  EXPECT_EQ(records[0].levels, all);
  EXPECT_EQ(records[0].stamp - PHAROS_CAPTURE_LATENCY_TICKS, lit);

  // Half rise while the others fall: one record too, in which the levels show the direction.
  const std::uint32_t odd = 0xAAAAAAAA & all;
  change(rig, odd);
  rig.ticks(kSettle);
  rig.drain();
  change(rig, all & ~odd);
  rig.ticks(kSettle);
  records = rig.drain();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].changed, all);
  EXPECT_EQ(records[0].levels, all & ~odd);
}

TEST(Edges, OfAPulseOfOneTickAreBothThere) {
  CaptureRig rig;
  rig.enable();
  const std::uint32_t rise = change(rig, 1);
  change(rig, 0);
  rig.ticks(kSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].stamp - PHAROS_CAPTURE_LATENCY_TICKS, rise);
  EXPECT_EQ(records[1].stamp, records[0].stamp + 1);
  EXPECT_EQ(records[0].levels, 1u);
  EXPECT_EQ(records[1].levels, 0u);
}

TEST(Edges, InEveryTickFillTheFifoToItsLastPlace) {
  CaptureRig rig;
  rig.enable();
  const auto first = static_cast<std::uint32_t>(rig.ticks());
  for (unsigned i = 0; i < rig.build().depth; ++i) change(rig, ~rig.pins());
  rig.ticks(kSettle);
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), 0u);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), rig.build().depth);
  for (unsigned i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].stamp - PHAROS_CAPTURE_LATENCY_TICKS, first + i);
    EXPECT_EQ(records[i].changed, rig.input_mask());
    EXPECT_EQ(records[i].gap(), i == 0);
  }
}

TEST(Edges, AreCountedInStatusTwoTicksAfterTheirStamp) {
  CaptureRig rig;
  rig.enable();
  const std::uint32_t tick = change(rig, 1);
  std::uint32_t count = 0;
  std::uint32_t read_at = 0;
  while (count == 0 && read_at != tick + 20) {
    read_at = static_cast<std::uint32_t>(rig.ticks());
    count = rig.read(PHAROS_CAPTURE_STATUS_OFFSET) & PHAROS_CAPTURE_STATUS_COUNT_MASK;
  }
  EXPECT_EQ(read_at, tick + PHAROS_CAPTURE_LATENCY_TICKS + PHAROS_CAPTURE_VISIBLE_AFTER_TICKS);
  const auto record = rig.read_record();
  ASSERT_TRUE(record);
  EXPECT_EQ(record->stamp, tick + PHAROS_CAPTURE_LATENCY_TICKS);
}

TEST(Edges, AroundTheWrapOfTheCounterKeepTheirDistance) {
  CaptureRig rig;
  rig.enable();
  rig.set_ticks((std::uint64_t{1} << 32) - 1 - PHAROS_CAPTURE_LATENCY_TICKS);
  change(rig, 1);
  change(rig, 0);
  rig.ticks(kSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].stamp, 0xFFFFFFFFu);
  EXPECT_EQ(records[1].stamp, 0u);
}

TEST(Edges, OfAPinThatIsHighAtResetOrAtEnablingAreNotInvented) {
  CaptureRig rig;
  rig.reset(rig.input_mask());
  rig.enable();
  rig.ticks(2 * kSettle);
  EXPECT_TRUE(rig.drain().empty());
  rig.write(PHAROS_CAPTURE_CONTROL_OFFSET, 0);
  change(rig, 0);
  rig.ticks(kSettle);
  rig.enable();
  rig.ticks(2 * kSettle);
  EXPECT_TRUE(rig.drain().empty());
}

TEST(Edges, OfInputsThatAreOffAreNotRecordedButTheirLevelsAre) {
  CaptureRig rig;
  rig.enable();
  rig.write(PHAROS_CAPTURE_INPUT_ENABLE_OFFSET, 0);
  change(rig, rig.input_mask());
  rig.ticks(kSettle);
  EXPECT_TRUE(rig.drain().empty());
  rig.write(PHAROS_CAPTURE_INPUT_ENABLE_OFFSET, 1);
  change(rig, rig.input_mask() & ~1u);
  rig.ticks(kSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].changed, 1u);
  EXPECT_EQ(records[0].levels, rig.input_mask() & ~1u);
  EXPECT_TRUE(records[0].gap());  // the set of enabled inputs changed since the last one
}

}  // namespace
}  // namespace pharos::rtl
