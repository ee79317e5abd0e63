// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/outline_scatter.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos::tof {
namespace {

constexpr double kSigma = 3.0;

// Of a square's outline with 60 pixels a side, of which so many neighbours have the same noise.
double mean_ratio(int shared) {
  double sum = 0.0;
  constexpr int kOutlines = 400;
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (int outline = 0; outline < kOutlines; ++outline) {
    OutlineScatter scatter;
    for (int side = 0; side < 4; ++side) {
      double noise = 0.0;
      for (int k = 0; k < 60; ++k) {
        if (k % shared == 0) noise = kSigma * normal(engine);
        scatter.add(side, (k + 0.5) / 30.0 - 1.0, 0.7, noise);
      }
    }
    sum += scatter.ratio(kSigma);
  }
  return sum / kOutlines;
}

// Twelve pieces, of which five unknowns are taken off although nothing was fitted here.
constexpr double kNotFitted = 12.0 / 7.0;

TEST(OutlineScatter, IndependentNoiseHasTheScatterOfItsPixels) { EXPECT_NEAR(mean_ratio(1), kNotFitted, 0.1); }

TEST(OutlineScatter, NoiseThatPixelsShareCountsAsOftenAsItIsShared) {
  EXPECT_NEAR(mean_ratio(5), 5.0 * kNotFitted, 0.5);
  EXPECT_NEAR(mean_ratio(10), 10.0 * kNotFitted, 1.0);
}

TEST(OutlineScatter, AnOutlineOfWhichTooLittleIsSeenIsTakenAsIndependent) {
  OutlineScatter scatter;
  for (int k = 0; k < 20; ++k) scatter.add(0, k / 10.0 - 1.0, 1.0, 100.0 * kSigma);
  EXPECT_EQ(scatter.ratio(kSigma), 1.0);
}

}  // namespace
}  // namespace pharos::tof
