// SPDX-License-Identifier: Apache-2.0
#include "pharos/base/ticks.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos {
namespace {

TEST(TicksDifference, IsRightAcrossTheWrap) {
  EXPECT_EQ(ticks_difference(5, 0xFFFFFFFBu), 10);
  EXPECT_EQ(ticks_difference(0xFFFFFFFBu, 5), -10);
  EXPECT_EQ(ticks_difference(0x80000000u, 1), 0x7FFFFFFF);
}

TEST(TickUnwrapper, FollowsManyWraps) {
  TickUnwrapper unwrapper;
  std::int64_t truth = 4'000'000'000;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(unwrapper.unwrap(static_cast<std::uint32_t>(truth)), truth);
    truth += 1'500'000'000;  // 30 s
  }
}

TEST(TickUnwrapper, IgnoresOneReadingOutOfRange) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    TickUnwrapper unwrapper;
    const std::int64_t first = unwrapper.unwrap(1000);
    unwrapper.unwrap(static_cast<std::uint32_t>(random()));
    EXPECT_EQ((unwrapper.unwrap(2000) - first) % (std::int64_t{1} << 32), 1000);
    // A reading that is wrong by less than 42.9 s, as in recordings, has no effect afterwards.
    TickUnwrapper stale;
    stale.unwrap(1000);
    stale.unwrap(1000u + static_cast<std::uint32_t>(random() % 2'000'000'000u));
    EXPECT_EQ(stale.unwrap(2000), 2000);
  }
}

}  // namespace
}  // namespace pharos
