// SPDX-License-Identifier: Apache-2.0
#include "pharos/base/noise_correlation.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos {
namespace {

// Variance of the mean of `count` draws of unit variance whose correlation falls by `rho` a draw, over 1 / count.
double simulated(double rho, int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr int kRuns = 4000;
  double square = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    double draw = normal(random), sum = draw;
    for (int i = 1; i < count; ++i) {
      draw = rho * draw + std::sqrt(1.0 - rho * rho) * normal(random);
      sum += draw;
    }
    square += sum * sum / count;
  }
  return square / kRuns;
}

TEST(NoiseCorrelation, IsWhatAveragingLeaves) {
  // 2,000 draws: the ends count for 1 %; 4,000 runs: 2.2 % (1 sigma).
  EXPECT_NEAR(simulated(std::exp(-0.1), 2000) / noise_correlation(0.2, 0.02), 1.0, 0.08);
  EXPECT_NEAR(simulated(std::exp(-1.0), 2000) / noise_correlation(0.2, 0.2), 1.0, 0.08);
}

// A pose's weight, 1 / correlation, is its step over twice the time as long as steps are short: a gap counts for what
// it is, and half as many poses in the same time weigh the same.
TEST(NoiseCorrelation, WeightsOfShortStepsAddUp) {
  EXPECT_NEAR(1.0 / noise_correlation(0.2, 0.02) + 1.0 / noise_correlation(0.2, 0.03), 0.05 / 0.4, 1e-3);
}

TEST(NoiseCorrelation, IsOneOfIndependentNoise) {
  EXPECT_EQ(noise_correlation(0.0, 0.01), 1.0);
  EXPECT_EQ(noise_correlation(0.2, 0.0), 1.0);
  EXPECT_EQ(noise_correlation(0.2, -1.0), 1.0);
  EXPECT_NEAR(noise_correlation(0.01, 1.0), 1.0, 1e-9);
}

}  // namespace
}  // namespace pharos
