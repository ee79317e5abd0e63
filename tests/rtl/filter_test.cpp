// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "firmware/rtl/capture_registers.h"
#include "rtl/capture_rig.hpp"

namespace pharos::rtl {
namespace {

constexpr unsigned kFilterSettle = PHAROS_CAPTURE_LATENCY_TICKS + PHAROS_CAPTURE_VISIBLE_AFTER_TICKS + 20;

void pulse(CaptureRig& rig, unsigned width) {
  rig.set_pins(1);
  rig.ticks(width);
  rig.set_pins(0);
  rig.ticks(kFilterSettle);
}

TEST(Filter, DropsAndCountsPulsesUpToItsLengthAndKeepsLongerOnesWithTheirWidth) {
  CaptureRig rig;
  rig.enable();
  const unsigned longest = (1u << rig.build().filter_width) - 1;
  std::uint32_t dropped = 0;
  for (unsigned length = 0; length <= longest; ++length) {
    rig.write(PHAROS_CAPTURE_FILTER_OFFSET, length);
    rig.ticks(2);
    for (unsigned width = 1; width <= longest + 2; ++width) {
      const auto rise = static_cast<std::uint32_t>(rig.ticks());
      pulse(rig, width);
      const auto records = rig.drain();
      if (width <= length) {
        EXPECT_TRUE(records.empty()) << length << " " << width;
        ++dropped;
      } else {
        ASSERT_EQ(records.size(), 2u) << length << " " << width;
        EXPECT_EQ(records[0].stamp - PHAROS_CAPTURE_LATENCY_TICKS - length, rise);
        EXPECT_EQ(records[1].stamp - records[0].stamp, width);
      }
      EXPECT_EQ(rig.read(PHAROS_CAPTURE_GLITCHES_OFFSET), dropped);
    }
  }
  EXPECT_TRUE(rig.agrees());
}

TEST(Filter, DropsShortDarknessInsideAPulseToo) {
  CaptureRig rig;
  rig.enable();
  rig.write(PHAROS_CAPTURE_FILTER_OFFSET, 1);
  rig.set_pins(1);
  rig.ticks(30);
  rig.set_pins(0);
  rig.ticks(1);
  rig.set_pins(1);
  rig.ticks(30);
  rig.set_pins(0);
  rig.ticks(kFilterSettle);
  const auto records = rig.drain();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[1].stamp - records[0].stamp, 61u);
}

TEST(Filter, StopsCountingGlitchesAtItsLargestNumber) {
  CaptureRig rig;
  rig.enable();
  rig.write(PHAROS_CAPTURE_FILTER_OFFSET, 1);
  for (int i = 0; i < 0x10010; ++i) {
    rig.set_pins(1);
    rig.ticks(1);
    rig.set_pins(0);
    rig.ticks(2);
  }
  rig.ticks(kFilterSettle);
  EXPECT_EQ(rig.read(PHAROS_CAPTURE_GLITCHES_OFFSET), 0xFFFFu);
  EXPECT_TRUE(rig.drain().empty());
}

}  // namespace
}  // namespace pharos::rtl
