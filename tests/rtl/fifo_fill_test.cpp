// SPDX-License-Identifier: Apache-2.0
#include "rtl/fifo_fill.hpp"

#include <gtest/gtest.h>

namespace pharos::rtl {
namespace {

using lighthouse::RawPulse;

TEST(FifoFill, EdgesOfOneTickAreOneRecord) {
  const std::vector<RawPulse> pulses{{100, 200, 0}, {100, 210, 1}, {150, 200, 2}};
  EXPECT_EQ(record_ticks(pulses, 0b111), (std::vector<std::int64_t>{100, 150, 200, 210}));
  EXPECT_EQ(record_ticks(pulses, 0b010), (std::vector<std::int64_t>{100, 210}));
}

TEST(FifoFill, TheBusiestSensorsAreThoseWithTheMostPulses) {
  const std::vector<RawPulse> pulses{{1, 2, 4}, {3, 4, 4}, {5, 6, 9}, {7, 8, 9}, {9, 10, 1}};
  EXPECT_EQ(busiest_sensors(pulses, 2), 1u << 4 | 1u << 9);
}

TEST(FifoFill, AReaderFasterThanTheRecordsNeverLetsTwoWait) {
  const std::vector<std::int64_t> records{0, 10, 20, 30};
  EXPECT_EQ(worst_fill(records, 10), 1u);
  EXPECT_EQ(worst_fill(records, 11), 2u);
  EXPECT_EQ(worst_fill(records, 20), 3u);  // one of the four was already read when the last one is stored
  EXPECT_EQ(worst_fill(records, 31), 4u);
}

TEST(FifoFill, TheDensestWindowIsFound) {
  const std::vector<std::int64_t> records{0, 10, 20, 500, 505, 508, 509};
  EXPECT_EQ(max_in_window(records, 9), 4u);
  EXPECT_EQ(max_in_window(records, 4), 3u);
  EXPECT_EQ(max_in_window(records, 1000), 7u);
}

}  // namespace
}  // namespace pharos::rtl
