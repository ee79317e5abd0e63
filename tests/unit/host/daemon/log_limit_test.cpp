// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/log_limit.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

TEST(LogLimit, PassesTheFirstAndTellsHowManyWereHeldBack) {
  LogLimit limit(1000);
  EXPECT_EQ(limit.pass("crc", 10), 0u);
  EXPECT_FALSE(limit.pass("crc", 11).has_value());
  EXPECT_FALSE(limit.pass("crc", 1009).has_value());
  EXPECT_EQ(limit.pass("crc", 1010), 2u);
  EXPECT_EQ(limit.pass("crc", 2010), 0u);
}

TEST(LogLimit, KindsDoNotHoldEachOtherBack) {
  LogLimit limit(1000);
  EXPECT_TRUE(limit.pass("crc", 0).has_value());
  EXPECT_TRUE(limit.pass("busy", 1).has_value());
}

}  // namespace
}  // namespace pharos::host
