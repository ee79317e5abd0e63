// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/spin.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos::slam {
namespace {

std::vector<TrackedFrame> turning(const Vector3& rate, int frames, double sigma_rad, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<TrackedFrame> out;
  for (int k = 0; k < frames; ++k) {
    TrackedFrame frame;
    frame.number = k;
    frame.time_s = 0.05 * k;
    frame.placed.emplace();
    const Vector3 error(noise(random), noise(random), noise(random));
    frame.placed->pose.R = rotation_exp(sigma_rad * error) * rotation_exp(rate * frame.time_s);
    out.push_back(frame);
  }
  return out;
}

TEST(Spin, IsExactOverTwoTurnsAndAGap) {
  std::mt19937_64 random(1);
  const Vector3 rate(0.02, -0.16, 0.05);
  auto frames = turning(rate, 1500, 0.0, random);
  for (std::size_t k = 300; k < 330; ++k) frames[k].placed.reset();
  const auto spin = fit_spin(frames);
  ASSERT_TRUE(spin);
  EXPECT_LT((spin->rate_rad_s - rate).norm(), 1e-9);
  EXPECT_NEAR(spin->turned_rad, rate.norm() * 0.05 * 1499, 1e-6);
  EXPECT_EQ(spin->frames, 1470);
}

TEST(Spin, CovarianceDescribesItsErrors) {
  std::mt19937_64 random(2);
  const Vector3 rate(0.0, 0.15, -0.05);
  double sum = 0.0;
  constexpr int kRuns = 100;
  for (int run = 0; run < kRuns; ++run) {
    const auto spin = fit_spin(turning(rate, 100, 0.002, random));
    ASSERT_TRUE(spin);
    const Vector3 error = spin->rate_rad_s - rate;
    sum += error.dot(spin->covariance.inverse() * error);
  }
  // 3 degrees of freedom +- 0.25; the correlation of white noise is estimated as 1 to 1.3.
  EXPECT_GT(sum / kRuns, 1.8);
  EXPECT_LT(sum / kRuns, 4.0);
}

TEST(Spin, NeedsTenFrames) {
  std::mt19937_64 random(3);
  EXPECT_FALSE(fit_spin(turning({0.0, 0.1, 0.0}, 9, 0.0, random)));
}

TEST(Spin, OfASteadyRotationStatesTheScatterWithoutItAndTheDifference) {
  std::mt19937_64 random(4);
  const Vector3 rate(0.0, 0.1, 0.02);
  const auto fit = fit_spin(turning(rate, 100, 0.002, random));
  ASSERT_TRUE(fit);
  const Vector3 off(0.0, 0.01, 0.0);
  const Spin steady = steady_spin(fit->rate_rad_s + off, *fit);
  EXPECT_EQ(steady.rate_rad_s, fit->rate_rad_s + off);
  EXPECT_NEAR(steady.covariance(1, 1), fit->covariance(1, 1) + 1e-4, 1e-12);
  EXPECT_NEAR(steady.covariance(0, 0), fit->covariance(0, 0), 1e-12);
  EXPECT_GT(steady.sigma_rate_rad_s(), fit->sigma_rate_rad_s());
  EXPECT_NEAR(steady.turned_rad / fit->turned_rad, steady.rate() / fit->rate(), 1e-12);
}

}  // namespace
}  // namespace pharos::slam
