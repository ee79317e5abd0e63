// SPDX-License-Identifier: Apache-2.0
#include "host/clock/steered_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos::host {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kUtc = 1'760'000'000'000'000'000;

TEST(SteeredClock, KeepsSingleNanosecondsAtTodaysUtc) {
  SteeredClock clock;
  clock.steer(1000, kUtc + 1, 1.0);
  EXPECT_EQ(clock.read(1000), kUtc + 1);
  EXPECT_EQ(clock.read(1001), kUtc + 2);
}

TEST(SteeredClock, WorksOffAnErrorSmoothly) {
  SteeredClock clock;
  clock.steer(0, kUtc + 10 * kMs, 1.0);
  std::int64_t last = *clock.read(0);
  for (std::int64_t time = 25 * kMs; time <= 5000 * kMs; time += 25 * kMs) {
    clock.steer(time, kUtc + time, 1.0);
    const std::int64_t shown = *clock.read(time);
    EXPECT_GE(shown - last, 25 * kMs / 2 - 1) << "never below half speed";
    last = shown;
  }
  EXPECT_NEAR(static_cast<double>(last - kUtc - 5000 * kMs), 0.0, 2e3);
}

TEST(SteeredClock, JumpsForwardsOnly) {
  SteeredClock clock;
  clock.steer(0, kUtc, 1.0);
  clock.steer(100 * kMs, kUtc + 10'000 * kMs, 1.0);
  EXPECT_EQ(clock.read(100 * kMs), kUtc + 10'000 * kMs);
  clock.steer(200 * kMs, kUtc, 1.0);
  EXPECT_GE(*clock.read(200 * kMs), kUtc + 10'000 * kMs);
  EXPECT_LT(clock.remaining_ns(), -9'000 * kMs);
}

TEST(SteeredClock, BeginsAnewWhereverItIsTold) {
  SteeredClock clock;
  clock.steer(0, kUtc, 1.0);
  clock.read(0);
  EXPECT_FALSE(clock.would_jump(-1000 * kMs));
  EXPECT_TRUE(clock.would_jump(-1001 * kMs));
  clock.reset();
  EXPECT_EQ(clock.read(1), std::nullopt);
  clock.steer(100 * kMs, kUtc - 5000 * kMs, 1.0);
  EXPECT_EQ(clock.read(100 * kMs), kUtc - 5000 * kMs);
  EXPECT_EQ(clock.remaining_ns(), 0);
}

TEST(SteeredClock, GoesOnFromWhereItWasAfterARestart) {
  SteeredClock clock;
  clock.steer(0, kUtc + 500 * kMs, 1.0);
  clock.read(100 * kMs);
  clock.restart();
  EXPECT_EQ(clock.read(0), std::nullopt);
  clock.steer(7, kUtc, 1.0);
  EXPECT_EQ(clock.read(7), kUtc + 600 * kMs);
}

}  // namespace
}  // namespace pharos::host
