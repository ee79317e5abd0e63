// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/remote/message_series.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace pharos::host {
namespace {

using Verdict = MessageSeries::Verdict;

constexpr std::int64_t kStep_ns = 10'000'000;

class Series : public ::testing::Test {
 protected:
  Verdict take(std::int64_t sequence, std::int64_t utime_us) {
    now_ns += kStep_ns;
    return series.take(sequence, utime_us, now_ns);
  }
  // With the time that belongs to it.
  Verdict next(std::int64_t sequence) { return take(sequence, now_ns / 1000); }

  MessageSeries series;
  std::int64_t now_ns = 4'000 * kStep_ns;
};

TEST_F(Series, GapsAreLosses) {
  next(7);
  EXPECT_EQ(next(8), Verdict::kNext);
  EXPECT_EQ(next(12), Verdict::kNext);
  EXPECT_EQ(series.lost(), 3);
}

TEST_F(Series, ALateMessageIsNoLoss) {
  take(1, 100);
  take(2, 200);
  take(4, 400);
  EXPECT_EQ(take(3, 300), Verdict::kNext);
  EXPECT_EQ(series.lost(), 0);
  EXPECT_EQ(take(3, 300), Verdict::kRepeated);
}

// Whatever is lost, doubled or exchanged by the network: never two publishers.
TEST_F(Series, OnePublisherOverABadNetworkIsOne) {
  std::mt19937_64 random(3);
  std::vector<std::int64_t> waiting;
  for (std::int64_t sequence = 0; sequence < 20'000; ++sequence) {
    if (random() % 10 == 0) continue;
    waiting.push_back(sequence);
    if (random() % 10 == 0) waiting.push_back(sequence);
    while (waiting.size() > 4) {
      const bool overdue = waiting.front() < sequence - 16;
      const auto at = waiting.begin() + (overdue ? 0 : static_cast<std::ptrdiff_t>(random() % 4));
      const Verdict verdict = take(*at, 1000 * *at);
      EXPECT_TRUE(verdict == Verdict::kNext || verdict == Verdict::kRepeated) << *at;
      waiting.erase(at);
    }
  }
  EXPECT_EQ(series.restarts(), 0);
  EXPECT_FALSE(series.doubled(now_ns));
}

TEST_F(Series, OneForeignMessageChangesNothing) {
  for (std::int64_t k = 0; k < 50; ++k) next(k);
  EXPECT_EQ(next(1'000'000), Verdict::kUnproven);
  for (std::int64_t k = 50; k < 100; ++k) EXPECT_EQ(next(k), Verdict::kNext);
  EXPECT_EQ(series.restarts(), 0);
}

TEST_F(Series, ARestartWithinTheFirstMessagesIsOne) {
  for (std::int64_t k = 0; k < 10; ++k) next(k);
  for (std::int64_t k = 0; k < 20; ++k) next(k);
  EXPECT_EQ(series.restarts(), 1);
  EXPECT_FALSE(series.doubled(now_ns));
}

TEST_F(Series, AWrongBeginningIsReplaced) {
  next(123'456'789);
  for (std::int64_t k = 0; k < 10; ++k) next(k);
  EXPECT_EQ(series.restarts(), 1);
  EXPECT_EQ(next(10), Verdict::kNext);
}

TEST_F(Series, AnyNumberMayCome) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max(),
                         kMin = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t sequence : {kMax, kMin, std::int64_t{0}, kMax - 1, kMin + 1, std::int64_t{-1}, kMax}) {
    for (const std::int64_t utime : {kMax, kMin, std::int64_t{0}}) take(sequence, utime);
  }
}

}  // namespace
}  // namespace pharos::host
