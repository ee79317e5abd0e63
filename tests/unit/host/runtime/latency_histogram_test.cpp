// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/latency_histogram.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

constexpr double kBinWidth = 1.0443;  // 2^(1/16): the largest factor by which a quantile is overestimated

TEST(LatencyHistogram, ReadsBackQuantilesToOneBin) {
  LatencyHistogram histogram;
  for (std::int64_t i = 1; i <= 1000; ++i) histogram.add(i * 10'000);
  EXPECT_EQ(histogram.count(), 1000u);
  for (const double q : {0.01, 0.5, 0.9, 0.99}) {
    const double truth_ns = q * 1e7;
    EXPECT_GE(static_cast<double>(histogram.quantile_ns(q)), truth_ns);
    EXPECT_LE(static_cast<double>(histogram.quantile_ns(q)), truth_ns * kBinWidth);
  }
}

TEST(LatencyHistogram, NeverReportsMoreThanTheLargest) {
  LatencyHistogram histogram;
  histogram.add(1'234'567);
  EXPECT_EQ(histogram.quantile_ns(0.5), 1'234'567);
  EXPECT_EQ(histogram.quantile_ns(1.0), histogram.max_ns());
}

TEST(LatencyHistogram, KeepsWhatIsBeyondItsEnds) {
  LatencyHistogram histogram;
  histogram.add(-5);              // a clock that stepped back
  histogram.add(60'000'000'000);  // a minute
  EXPECT_EQ(histogram.count(), 2u);
  EXPECT_LE(histogram.quantile_ns(0.5), 1000);
  EXPECT_EQ(histogram.max_ns(), 60'000'000'000);
}

// Ages of poses of a recording that is replayed days later.
TEST(LatencyHistogram, DaysAndMoreAreNotCappedAtAnEdge) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  LatencyHistogram histogram;
  for (int i = 0; i < 10; ++i) histogram.add(kHour_ns);
  histogram.add(10'000 * kHour_ns);  // over a year: beyond the last bin edge
  EXPECT_GE(histogram.quantile_ns(0.5), kHour_ns);
  EXPECT_LE(static_cast<double>(histogram.quantile_ns(0.5)), static_cast<double>(kHour_ns) * kBinWidth);
  EXPECT_EQ(histogram.quantile_ns(1.0), 10'000 * kHour_ns);
}

TEST(LatencyHistogram, IsEmptyUntilFedAndAfterClear) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.99), 0);
  histogram.add(1000);
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0u);
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
}

}  // namespace
}  // namespace pharos::host
