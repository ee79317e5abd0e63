// SPDX-License-Identifier: Apache-2.0
#include "host/clock/clock_map.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "unit/host/clock/simulated_line.hpp"

namespace pharos::host {
namespace {

using test::LatencyModel;
using test::SimulatedLine;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kS = 1'000'000'000;

SimulatedLine::Pair feed(ClockMap& map, SimulatedLine& line) {
  const auto pair = line.next();
  map.add(pair.ticks, pair.arrival_utc_ns, pair.arrival_monotonic_ns);
  return pair;
}

SimulatedLine::Pair feed_seconds(ClockMap& map, SimulatedLine& line, double seconds) {
  SimulatedLine::Pair last;
  for (int i = 0; i < static_cast<int>(seconds * 116.0); ++i) last = feed(map, line);
  return last;
}

std::int64_t utc_error_ns(ClockMap& map, const SimulatedLine& line, const SimulatedLine::Pair& pair) {
  return std::abs(map.map(pair.ticks)->utc_ns - pair.truth_ns - line.utc_offset_ns());
}

struct Kind {
  const char* name;
  LatencyModel latency;
  double after_3_s_us;  // bounds on the largest error from then on
  double after_20_s_us;
};

const std::vector<Kind> kKinds{
    {"plain UART, 0.2 ms jitter", {200e3, 0, 0.0, 0}, 250.0, 20.0},
    {"USB, 1 ms polls", {100e3, 1 * kMs, 0.0, 0}, 250.0, 120.0},
    {"USB, 16 ms latency timer", {200e3, 16 * kMs, 0.0, 0}, 1500.0, 700.0},
    {"busy host, 20 % stalled 40 ms", {500e3, 0, 0.2, 40 * kMs}, 250.0, 40.0},
};

TEST(ClockMap, ConvergesWithinSecondsForEveryLineAndDrift) {
  std::printf("%-32s %16s %16s %12s\n", "line", "max 3-20 s, us", "max 20-90 s, us", "drift, ppm");
  for (const Kind& kind : kKinds) {
    double early_us = 0.0;
    double late_us = 0.0;
    double drift_error_ppm = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const double drift_ppm = -100.0 + 200.0 * static_cast<double>(seed - 1) / 9.0;
      SimulatedLine line(seed, drift_ppm, kind.latency);
      ClockMap map;
      for (int i = 0; i < 9000; ++i) {
        const auto pair = feed(map, line);
        if (i < 300) continue;
        const auto mapped = map.map(pair.ticks);
        ASSERT_TRUE(mapped.has_value());
        const double error_us = static_cast<double>(mapped->utc_ns - pair.truth_ns - line.utc_offset_ns()) * 1e-3;
        (i < 2000 ? early_us : late_us) = std::max(i < 2000 ? early_us : late_us, std::abs(error_us));
      }
      EXPECT_LT(static_cast<double>(map.sigma_ns()) * 1e-3, 2.0 * kind.after_20_s_us) << "sigma says something";
      drift_error_ppm = std::max(drift_error_ppm, std::abs(map.drift_ppm() - drift_ppm));
      EXPECT_EQ(map.counters().resynchronised, 0u);
      EXPECT_EQ(map.counters().pairs_ignored, 0u);
    }
    std::printf("%-32s %16.1f %16.1f %12.2f\n", kind.name, early_us, late_us, drift_error_ppm);
    EXPECT_LT(early_us, kind.after_3_s_us) << kind.name;
    EXPECT_LT(late_us, kind.after_20_s_us) << kind.name;
    EXPECT_LT(drift_error_ppm, 6.0) << kind.name;
  }
}

TEST(ClockMap, StatesAnUncertaintyThatHolds) {
  for (const Kind& kind : kKinds) {
    int inside = 0;
    int all = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SimulatedLine line(100 + seed, 80.0 - 16.0 * static_cast<double>(seed), kind.latency);
      ClockMap map;
      for (int i = 0; i < 3000; ++i) {
        const auto pair = feed(map, line);
        const auto mapped = map.map(pair.ticks);
        if (!mapped) continue;
        const std::int64_t error = std::abs(mapped->utc_ns - pair.truth_ns - line.utc_offset_ns());
        ++all;
        inside += error <= 3 * mapped->sigma_ns ? 1 : 0;
      }
    }
    EXPECT_GT(all, 29'000);
    EXPECT_GE(inside, 0.99 * all) << kind.name;
  }
}

TEST(ClockMap, TakesOffTheLatencyThatIsCertain) {
  SimulatedLine line(4, 10.0, {50e3, 0, 0.0, 0});
  ClockMap map;
  SimulatedLine::Pair last;
  constexpr std::int64_t kOnTheLine = line_time_ns(86, 460'800);
  EXPECT_EQ(kOnTheLine, 86 * 10 * kS / 460'800);
  for (int i = 0; i < 3000; ++i) {
    last = line.next();
    map.add(last.ticks, last.arrival_utc_ns + kOnTheLine, last.arrival_monotonic_ns + kOnTheLine, kOnTheLine);
  }
  EXPECT_NEAR(static_cast<double>(map.map(last.ticks)->utc_ns - last.truth_ns - line.utc_offset_ns()), 0.0, 50e3);
}

TEST(ClockMap, RunsBackwardsOnlyWhereAHostJumpIsCounted) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SimulatedLine line(1000 + seed, 100.0, {1e6, static_cast<std::int64_t>(seed % 3) * 8 * kMs, 0.05, 300 * kMs});
    ClockMap map;
    std::int64_t last_utc = 0;  // of any time mapped, across restarts too
    std::int64_t last_ticks = 0;
    std::uint64_t jumps = 0;
    for (int i = 0; i < 3000; ++i) {
      switch (line.random()() % 800) {
        case 0:
          line.step_utc(-static_cast<std::int64_t>(line.random()() % (3 * kS)));
          break;
        case 1:
          line.step_utc(static_cast<std::int64_t>(line.random()() % (100 * kS)));
          break;
        case 2:
          line.restart_counter(static_cast<std::int64_t>(line.random()() % 1'000'000));
          if (line.random()() % 2 == 0) map.restart();
          last_ticks = 0;
          break;
        default:
          break;
      }
      const auto pair = feed(map, line);
      if (map.counters().host_jumps != jumps) last_utc = last_ticks = 0;
      jumps = map.counters().host_jumps;
      // Queries at any time up to the newest, and a little beyond.
      for (const std::int64_t back_ms : {180, 90, 20, 0, -20}) {
        const std::int64_t ticks = pair.ticks - back_ms * 50'000;
        if (ticks < last_ticks) continue;
        const auto mapped = map.map(ticks);
        if (!mapped) continue;
        ASSERT_GE(mapped->utc_ns, last_utc) << "seed " << seed << " frame " << i;
        last_utc = mapped->utc_ns;
        last_ticks = ticks;
      }
    }
    EXPECT_GT(last_utc, 0);
  }
}

TEST(ClockMap, WorksOffASmallStepOfTheHostClockAtHalfSpeedAtTheSlowest) {
  SimulatedLine line(5, 20.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  feed_seconds(map, line, 10);
  line.step_utc(-900 * kMs);
  const auto soon = feed_seconds(map, line, 0.5);
  EXPECT_GT(utc_error_ns(map, line, soon), 500 * kMs);
  EXPECT_GT(map.map(soon.ticks)->sigma_ns, 500 * kMs) << "what is still to be worked off is stated";
  EXPECT_LT(std::abs(map.map(soon.ticks)->monotonic_ns - soon.truth_ns), kMs) << "ages stay right";
  EXPECT_LT(utc_error_ns(map, line, feed_seconds(map, line, 9)), kMs);
  EXPECT_EQ(map.counters().host_steps, 1u);
  EXPECT_EQ(map.counters().host_jumps, 0u);
}

TEST(ClockMap, BeginsUtcAnewWhenTheHostClockIsSetByHours) {
  for (const std::int64_t step_ns : {3600 * kS, -3600 * kS, -1100 * kMs, 86'400 * kS, -10 * 86'400 * kS}) {
    SimulatedLine line(5, 20.0, {100e3, 0, 0.0, 0});
    ClockMap map;
    feed_seconds(map, line, 10);
    line.step_utc(step_ns);
    const auto at_once = feed_seconds(map, line, 0.1);
    ASSERT_TRUE(map.map(at_once.ticks).has_value()) << "no gap: the ticks are still understood";
    EXPECT_LT(utc_error_ns(map, line, at_once), kMs) << step_ns;
    EXPECT_LT(map.map(at_once.ticks)->sigma_ns, kMs);
    EXPECT_LT(std::abs(map.map(at_once.ticks)->monotonic_ns - at_once.truth_ns), kMs);
    EXPECT_EQ(map.counters().host_jumps, 1u) << "the visible reason";
    EXPECT_NEAR(static_cast<double>(map.last_jump_ns()), static_cast<double>(step_ns), 1e6);
    EXPECT_EQ(map.counters().resynchronised, 0u);
    EXPECT_LT(utc_error_ns(map, line, feed_seconds(map, line, 5)), kMs) << "and it stays so";
    EXPECT_EQ(map.counters().host_jumps, 1u);
  }
}

TEST(ClockMap, ManySmallStepsBackAreNotWorkedOffForEver) {
  SimulatedLine line(12, 20.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  feed_seconds(map, line, 10);
  for (int i = 0; i < 20; ++i) {
    line.step_utc(-900 * kMs);
    EXPECT_LT(utc_error_ns(map, line, feed_seconds(map, line, 0.1)), 1100 * kMs) << i;
  }
}

TEST(ClockMap, FindsARestartedTargetByItselfWithinHalfASecond) {
  SimulatedLine line(6, -30.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  feed_seconds(map, line, 10);
  line.restart_counter(1000);
  const auto first = feed(map, line);
  EXPECT_EQ(map.map(first.ticks), std::nullopt) << "new ticks have no meaning in the old mapping";
  const auto later = feed_seconds(map, line, 0.8);
  ASSERT_TRUE(map.map(later.ticks).has_value());
  EXPECT_LT(std::abs(map.map(later.ticks)->monotonic_ns - later.truth_ns), kMs);
  EXPECT_EQ(map.counters().resynchronised, 1u);
}

TEST(ClockMap, FindsATargetThatRestartsSoonAfterItsStart) {
  SimulatedLine line(11, -30.0, {100e3, 0, 0.0, 0});
  line.restart_counter(0);
  ClockMap map;
  feed_seconds(map, line, 3);
  line.restart_counter(0);
  EXPECT_EQ(map.map(feed(map, line).ticks), std::nullopt) << "the tick exists in the old mapping, three seconds ago";
  const auto later = feed_seconds(map, line, 0.8);
  ASSERT_TRUE(map.map(later.ticks).has_value());
  EXPECT_LT(std::abs(map.map(later.ticks)->monotonic_ns - later.truth_ns), kMs);
}

TEST(ClockMap, DropsTheOldCounterAtARestart) {
  SimulatedLine line(7, -30.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  const auto old = feed_seconds(map, line, 10);
  line.restart_counter(1000);
  map.restart();
  EXPECT_FALSE(map.synchronised());
  EXPECT_EQ(map.sigma_ns(), -1);
  EXPECT_EQ(map.map(old.ticks), std::nullopt);
  const auto later = feed_seconds(map, line, 0.3);
  ASSERT_TRUE(map.map(later.ticks).has_value());
  EXPECT_EQ(map.counters().pairs_ignored, 0u);
}

TEST(ClockMap, IgnoresASingleOutlierTime) {
  SimulatedLine line(8, 0.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  feed_seconds(map, line, 10);
  for (const std::int64_t error_s : {-1000, 37, 100'000}) {
    auto pair = line.next();
    map.add(pair.ticks + error_s * 50'000'000, pair.arrival_utc_ns, pair.arrival_monotonic_ns);
    pair = feed_seconds(map, line, 1);
    ASSERT_TRUE(map.map(pair.ticks).has_value());
    EXPECT_LT(std::abs(map.map(pair.ticks)->utc_ns - pair.truth_ns - line.utc_offset_ns()), kMs);
  }
  EXPECT_EQ(map.counters().pairs_ignored, 3u);
  EXPECT_EQ(map.counters().resynchronised, 0u);
}

// A false time `ahead_ns` ahead of the truth among good ones, at index `at`.
void expect_unbent(int at, std::int64_t ahead_ns) {
  SimulatedLine line(13, 40.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  for (int i = 0; i < 4000; ++i) {
    auto pair = line.next();
    if (i == at) map.add(pair.ticks + ahead_ns / 20, pair.arrival_utc_ns, pair.arrival_monotonic_ns);
    map.add(pair.ticks, pair.arrival_utc_ns, pair.arrival_monotonic_ns);
    if (i < 120 || i == at) continue;
    const auto mapped = map.map(pair.ticks);
    ASSERT_TRUE(mapped.has_value()) << "at " << at << ", " << ahead_ns << " ns ahead, pair " << i;
    ASSERT_LT(std::abs(mapped->utc_ns - pair.truth_ns - line.utc_offset_ns()), kMs)
        << "at " << at << ", " << ahead_ns << " ns ahead, pair " << i;
    ASSERT_GT(mapped->sigma_ns, 0);
  }
}

TEST(ClockMap, OneFalseTimeBendsNothingWhereverItComes) {
  for (const int at : {0, 1, 5, 60, 200, 1000, 2500}) {
    for (const std::int64_t ahead_ns :
         {kMs, 10 * kMs, 49 * kMs, 240 * kMs, 3 * kS, -kMs, -49 * kMs, -240 * kMs, -3 * kS}) {
      expect_unbent(at, ahead_ns);
    }
  }
}

TEST(ClockMap, IsNotFooledByBytesThatWaitedInTheKernel) {
  SimulatedLine line(9, 0.0, {100e3, 0, 0.0, 0});
  std::vector<SimulatedLine::Pair> waited;
  for (int i = 0; i < 150; ++i) waited.push_back(line.next());
  ClockMap map;
  for (const auto& pair : waited) map.add(pair.ticks, waited.back().arrival_utc_ns, waited.back().arrival_monotonic_ns);
  EXPECT_EQ(map.map(waited.back().ticks), std::nullopt) << "all arrived at once: nothing is known yet";
  const auto pair = feed_seconds(map, line, 0.5);
  ASSERT_TRUE(map.map(pair.ticks).has_value());
  EXPECT_LT(std::abs(map.map(pair.ticks)->utc_ns - pair.truth_ns - line.utc_offset_ns()), kMs);
}

TEST(ClockMap, GivesNoTimeForInstantsFarFromTheNewestPair) {
  SimulatedLine line(10, 0.0, {100e3, 0, 0.0, 0});
  ClockMap map;
  EXPECT_EQ(map.map(0), std::nullopt);
  const auto pair = feed_seconds(map, line, 10);
  EXPECT_TRUE(map.map(pair.ticks - 200'000'000).has_value());
  EXPECT_EQ(map.map(pair.ticks - 300'000'000), std::nullopt);
  EXPECT_EQ(map.map(pair.ticks + 300'000'000), std::nullopt);
}

}  // namespace
}  // namespace pharos::host
