// SPDX-License-Identifier: Apache-2.0
#include "host/clock/lower_envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace pharos::host {
namespace {

TEST(LowerEnvelope, FindsTheLineUnderOneSidedNoise) {
  std::mt19937_64 random(1);
  std::exponential_distribution<double> latency(1.0 / 1e6);
  LowerEnvelope envelope;
  for (int i = 0; i < 5000; ++i) {
    const double time_s = 0.01 * i;
    envelope.add(time_s, 5e6 - 30e3 * time_s + latency(random));
  }
  const auto line = envelope.fit();
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->drift_ns_per_s, -30e3, 2e3);
  EXPECT_NEAR(line->value(50.0), 5e6 - 30e3 * 50.0, 60e3);
}

TEST(LowerEnvelope, LiesBelowAllButOnePointOfEachHalfSecond) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    LowerEnvelope envelope;
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < 400; ++i) {
      points.emplace_back(0.1 * i, static_cast<double>(random() % 1'000'000));
      envelope.add(points.back().first, points.back().second);
    }
    const auto line = envelope.fit();
    std::map<int, int> below;
    double min_touch = 1e9;
    for (const auto& [time_s, delay_ns] : points) {
      const double height_ns = delay_ns - line->value(time_s);
      if (height_ns < -1e-3) ++below[static_cast<int>(std::floor(time_s / 0.5))];
      min_touch = std::min(min_touch, std::abs(height_ns));
    }
    for (const auto& [half_second, count] : below) EXPECT_EQ(count, 1) << half_second;
    EXPECT_NEAR(min_touch, 0.0, 1e-3) << "and it touches one";
  }
}

TEST(LowerEnvelope, OneFalsePointLeavesNoTraceWhereverItLies) {
  for (const int at : {0, 3, 172, 399}) {
    for (const double below_ns : {1e6, 1e9, 1e15}) {
      std::mt19937_64 random(3);
      std::exponential_distribution<double> latency(1.0 / 20e3);
      LowerEnvelope envelope;
      for (int i = 0; i < 400; ++i) {
        const double time_s = 0.1 * i;
        if (i == at) envelope.add(time_s, 5e6 - below_ns);
        envelope.add(time_s, 5e6 - 30e3 * time_s + latency(random));
      }
      const auto line = envelope.fit();
      EXPECT_NEAR(line->drift_ns_per_s, -30e3, 1e3) << at << ", " << below_ns << " ns below";
      EXPECT_NEAR(line->value(20.0), 5e6 - 30e3 * 20.0, 20e3) << at << ", " << below_ns << " ns below";
    }
  }
}

TEST(LowerEnvelope, TakesNoSlopeFromTwoSeconds) {
  LowerEnvelope envelope;
  EXPECT_FALSE(envelope.fit().has_value());
  envelope.add(0.0, 9e6);
  envelope.add(1.9, 1e6);
  EXPECT_EQ(envelope.fit()->drift_ns_per_s, 0.0);
  EXPECT_EQ(envelope.fit()->value(1.9), 1e6);
}

TEST(LowerEnvelope, ForgetsWhatIsOlderThanAMinute) {
  LowerEnvelope envelope;
  envelope.add(0.0, -5e6);
  for (int i = 0; i < 130; ++i) envelope.add(i, 1e6);
  EXPECT_NEAR(envelope.fit()->value(129.0), 1e6, 1.0);
}

}  // namespace
}  // namespace pharos::host
