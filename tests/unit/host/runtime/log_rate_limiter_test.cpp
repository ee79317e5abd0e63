// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/log_rate_limiter.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

TEST(LogRateLimiter, PassesTheFirstAndReportsHowManyWereSuppressed) {
  LogRateLimiter limit(1000);
  EXPECT_EQ(limit.pass("crc", 10), 0u);
  EXPECT_FALSE(limit.pass("crc", 11).has_value());
  EXPECT_FALSE(limit.pass("crc", 1009).has_value());
  EXPECT_EQ(limit.pass("crc", 1010), 2u);
  EXPECT_EQ(limit.pass("crc", 2010), 0u);
}

TEST(LogRateLimiter, LetsAFewPassInAPeriodAndCountsAllOfTheOthers) {
  LogRateLimiter limit(1000, 3);
  int passed = 0;
  for (int i = 0; i < 500; ++i) passed += limit.pass("restart", 10 + i).has_value() ? 1 : 0;
  EXPECT_EQ(passed, 3);
  EXPECT_EQ(limit.suppressed(), 497u);
  EXPECT_EQ(limit.pass("restart", 1010), 497u);
  EXPECT_EQ(limit.pass("restart", 1011), 0u) << "told once";
  EXPECT_EQ(suppressed_note(0), "");
  EXPECT_EQ(suppressed_note(497), " (497 more lines like this were held back)");
}

TEST(LogRateLimiter, KindsDoNotHoldEachOtherBack) {
  LogRateLimiter limit(1000);
  EXPECT_TRUE(limit.pass("crc", 0).has_value());
  EXPECT_TRUE(limit.pass("busy", 1).has_value());
}

}  // namespace
}  // namespace pharos::host
