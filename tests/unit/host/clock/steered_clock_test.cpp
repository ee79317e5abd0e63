// SPDX-License-Identifier: Apache-2.0
#include "host/clock/steered_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos::host {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kUtc = 1'760'000'000'000'000'000;

TEST(SteeredClock, KeepsSingleNanosecondsAtTodaysUtc) {
  SteeredClock clock;
  clock.steer(1000, kUtc + 1, 1.0);
  EXPECT_EQ(clock.read(1000), kUtc + 1);
  EXPECT_EQ(clock.read(1001), kUtc + 2);
}

TEST(SteeredClock, WorksOffAnErrorSmoothly) {
  SteeredClock clock;
  clock.steer(0, kUtc + 10 * kMillisecond_ns, 1.0);
  std::int64_t last = *clock.read(0);
  for (std::int64_t time = 25 * kMillisecond_ns; time <= 5000 * kMillisecond_ns; time += 25 * kMillisecond_ns) {
    clock.steer(time, kUtc + time, 1.0);
    const std::int64_t shown = *clock.read(time);
    EXPECT_GE(shown - last, 25 * kMillisecond_ns / 2 - 1) << "never below half speed";
    last = shown;
  }
  EXPECT_NEAR(static_cast<double>(last - kUtc - 5000 * kMillisecond_ns), 0.0, 2e3);
}

TEST(SteeredClock, JumpsForwardsOnly) {
  SteeredClock clock;
  clock.steer(0, kUtc, 1.0);
  clock.steer(100 * kMillisecond_ns, kUtc + 10'000 * kMillisecond_ns, 1.0);
  EXPECT_EQ(clock.read(100 * kMillisecond_ns), kUtc + 10'000 * kMillisecond_ns);
  clock.steer(200 * kMillisecond_ns, kUtc, 1.0);
  EXPECT_GE(*clock.read(200 * kMillisecond_ns), kUtc + 10'000 * kMillisecond_ns);
  EXPECT_LT(clock.remaining_ns(), -9'000 * kMillisecond_ns);
}

TEST(SteeredClock, ResetsAtAnyTime) {
  SteeredClock clock;
  clock.steer(0, kUtc, 1.0);
  clock.read(0);
  EXPECT_FALSE(clock.would_jump(-1000 * kMillisecond_ns));
  EXPECT_TRUE(clock.would_jump(-1001 * kMillisecond_ns));
  clock.reset();
  EXPECT_EQ(clock.read(1), std::nullopt);
  clock.steer(100 * kMillisecond_ns, kUtc - 5000 * kMillisecond_ns, 1.0);
  EXPECT_EQ(clock.read(100 * kMillisecond_ns), kUtc - 5000 * kMillisecond_ns);
  EXPECT_EQ(clock.remaining_ns(), 0);
}

TEST(SteeredClock, GoesOnFromWhereItWasAfterARestart) {
  SteeredClock clock;
  clock.steer(0, kUtc + 500 * kMillisecond_ns, 1.0);
  clock.read(100 * kMillisecond_ns);
  clock.restart();
  EXPECT_EQ(clock.read(0), std::nullopt);
  clock.steer(7, kUtc, 1.0);
  EXPECT_EQ(clock.read(7), kUtc + 600 * kMillisecond_ns);
}

}  // namespace
}  // namespace pharos::host
