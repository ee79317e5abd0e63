// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/rtl/capture_registers.h"
#include "rtl/capture_rig.hpp"

namespace pharos::rtl {
namespace {

constexpr unsigned kOverflowSettle = PHAROS_CAPTURE_LATENCY_TICKS + PHAROS_CAPTURE_VISIBLE_AFTER_TICKS;

// All inputs change in each of `ticks` ticks.
void toggle(CaptureRig& rig, unsigned ticks) {
  for (unsigned i = 0; i < ticks; ++i) {
    rig.set_pins(~rig.pins());
    rig.tick();
  }
}

bool overflow(CaptureRig& rig) {
  return (rig.read(PHAROS_CAPTURE_STATUS_OFFSET) & PHAROS_CAPTURE_STATUS_OVERFLOW) != 0;
}

std::uint32_t max_lost(const CaptureRig& rig) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << rig.build().lost_width) - 1);
}

TEST(Overflow, CountsEveryEdgeThatFoundNoRoom) {
  CaptureRig rig;
  rig.enable();
  toggle(rig, rig.build().depth);
  rig.ticks(kOverflowSettle);
  EXPECT_FALSE(overflow(rig));
  for (unsigned beyond = 1; beyond <= 3; ++beyond) {
    toggle(rig, 1);
    rig.ticks(kOverflowSettle);
    EXPECT_TRUE(overflow(rig));
    EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), std::min(beyond * rig.build().inputs, max_lost(rig)));
  }
}

TEST(Overflow, FarBeyondLeavesTheOldestRecordsWhole) {
  CaptureRig rig;
  rig.enable();
  const auto first = static_cast<std::uint32_t>(rig.ticks());
  const unsigned extra = 50 * rig.build().depth;
  toggle(rig, rig.build().depth + extra);
  rig.ticks(kOverflowSettle);
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), std::min(extra * rig.build().inputs, max_lost(rig)));
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), rig.build().depth);
  for (unsigned i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].stamp, first + i + PHAROS_CAPTURE_LATENCY_TICKS);
  }
}

#if PHAROS_RTL_LOST_WIDTH <= 16  // a wider counter is not filled in a test
TEST(Overflow, StopsCountingAtItsLargestNumberInsteadOfStartingAnew) {
  CaptureRig rig;
  rig.enable();
  toggle(rig, rig.build().depth + max_lost(rig) + 40);
  rig.ticks(kOverflowSettle);
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), max_lost(rig));
}
#endif

TEST(Overflow, MarksTheRecordBehindTheGapAndItsLevelsAreTrue) {
  CaptureRig rig;
  rig.enable();
  const unsigned depth = rig.build().depth;
  toggle(rig, depth + 7);
  rig.ticks(kOverflowSettle);
  rig.read_record();
  rig.read_record();
  toggle(rig, 1);
  const std::uint32_t levels_behind = rig.pins();
  rig.ticks(kOverflowSettle);
  toggle(rig, 1);
  rig.ticks(kOverflowSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), depth);
  for (unsigned i = 0; i < depth; ++i) EXPECT_EQ(records[i].gap(), i == depth - 2) << i;
  EXPECT_EQ(records[depth - 2].levels, levels_behind);
}

TEST(Overflow, IsReportedUntilItIsClearedAndAgainWhenItComesAgain) {
  CaptureRig rig;
  rig.enable();
  toggle(rig, rig.build().depth + 1);
  rig.ticks(kOverflowSettle);
  rig.drain();
  EXPECT_TRUE(overflow(rig));
  rig.write(PHAROS_CAPTURE_STATUS_OFFSET, 0);
  EXPECT_TRUE(overflow(rig));
  rig.write(PHAROS_CAPTURE_STATUS_OFFSET, PHAROS_CAPTURE_STATUS_OVERFLOW);
  EXPECT_FALSE(overflow(rig));
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), rig.build().inputs);  // clearing the flag does not reset the count
  toggle(rig, rig.build().depth + 1);
  rig.ticks(kOverflowSettle);
  EXPECT_TRUE(overflow(rig));
}

TEST(Overflow, IsNotForgottenWhenClearedInTheTickOfTheNextLoss) {
  CaptureRig rig;
  rig.enable();
  toggle(rig, rig.build().depth);
  rig.ticks(kOverflowSettle);
  toggle(rig, 1);
  rig.ticks(PHAROS_CAPTURE_LATENCY_TICKS - 1);
  rig.write(PHAROS_CAPTURE_STATUS_OFFSET, PHAROS_CAPTURE_STATUS_OVERFLOW);
  EXPECT_TRUE(overflow(rig));
}

TEST(Overflow, LeavesEveryEdgeEitherRecordedOrCounted) {
  CaptureRig rig;
  rig.enable();
  std::uint64_t recorded = 0;
  std::uint64_t made = 0;
  // A reader that is too slow, over many overflows.
  for (unsigned round = 0; round < 40 && made < max_lost(rig); ++round) {
    toggle(rig, 1 + (round * 7) % 5);
    made += (1 + (round * 7) % 5) * rig.build().inputs;
    rig.ticks(kOverflowSettle);
    if (round % 3 == 0) recorded += rig.read_record() ? rig.build().inputs : 0;
  }
  rig.ticks(kOverflowSettle);
  recorded += rig.drain().size() * rig.build().inputs;
  EXPECT_EQ(recorded + rig.read(PHAROS_CAPTURE_LOST_OFFSET), made);
}

TEST(Clearing, EmptiesTheFifoAndMarksWhatFollows) {
  CaptureRig rig;
  rig.enable();
  toggle(rig, rig.build().depth);
  rig.ticks(kOverflowSettle);
  rig.write(PHAROS_CAPTURE_CONTROL_OFFSET, PHAROS_CAPTURE_CONTROL_ENABLE | PHAROS_CAPTURE_CONTROL_CLEAR_FIFO);
  EXPECT_TRUE(rig.drain().empty());
  toggle(rig, 1);
  rig.ticks(kOverflowSettle);
  toggle(rig, 1);
  rig.ticks(kOverflowSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_TRUE(records[0].gap());
  EXPECT_FALSE(records[1].gap());
}

TEST(Disabling, KeepsRecordsAndMarksTheFirstOneAfterEnabling) {
  CaptureRig rig;
  rig.enable();
  toggle(rig, 1);
  rig.ticks(kOverflowSettle);
  rig.write(PHAROS_CAPTURE_CONTROL_OFFSET, 0);
  toggle(rig, 30);
  rig.ticks(kOverflowSettle);
  EXPECT_EQ(rig.drain().size(), 1u);
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_LOST_OFFSET), 0u);  // the inputs are not enabled
  rig.enable();
  toggle(rig, 1);
  rig.ticks(kOverflowSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_TRUE(records[0].gap());
}

}  // namespace
}  // namespace pharos::rtl
