// SPDX-License-Identifier: Apache-2.0
// (4) to (6) of paper 004 and their fast solver, compared with an exact one.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "host/vision/enhance/smoothness.hpp"
#include "host/vision/enhance/smoothness_solver.hpp"
#include "tools/evaluation/bench/exact_illumination.hpp"
#include "unit/host/vision/enhance/test_images.hpp"

namespace pharos::enhance {
namespace {

constexpr double kTolerance = 5e-3;  // as Enhancer uses it
constexpr int kMax = 60;

struct Case {
  WeightStrategy strategy;
  float light;
  const char* name;
  friend void PrintTo(const Case& it, std::ostream* out) { *out << it.name; }
};

class Illumination : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    start_ = test::painted_target(211, 157, GetParam().light);
    test::add_noise(start_, 0.01 * static_cast<double>(GetParam().light), 1);
    test::round_to_8_bits(start_);
    SmoothnessWeights().weigh(start_, GetParam().strategy, 0.15, 2.0, system_);
  }
  FloatImage start_;
  SmoothnessSystem system_;
};

TEST_P(Illumination, FastSolverAgreesWithTheExactOne) {
  const FloatImage exact = tools::exact_illumination(system_, start_);
  FloatImage refined;
  SmoothnessSolver solver;
  const int cold = solver.solve(system_, start_, kTolerance, kMax, refined);
  EXPECT_LE(tools::rms_of_range(refined, exact), kTolerance);
  EXPECT_LT(cold, kMax);

  // The same frame again, starting from its own solution: few iterations.
  const int again = solver.solve(system_, start_, kTolerance, kMax, refined);
  EXPECT_LE(again, cold / 2);
  EXPECT_LE(tools::rms_of_range(refined, exact), kTolerance);
}

TEST_P(Illumination, WarmStartFromANeighbouringFrameEndsAtTheSameSolution) {
  FloatImage moved = start_;
  for (std::int32_t v = 0; v < start_.height_px; ++v) {
    for (std::int32_t u = 2; u < start_.width_px; ++u) moved.view().at(u, v) = start_.view().at(u - 2, v);
  }
  SmoothnessSystem system;
  SmoothnessWeights().weigh(moved, GetParam().strategy, 0.15, 2.0, system);
  SmoothnessSolver solver;
  FloatImage refined;
  solver.solve(system_, start_, kTolerance, kMax, refined);
  solver.solve(system, moved, kTolerance, kMax, refined);
  EXPECT_LE(tools::rms_of_range(refined, tools::exact_illumination(system, moved)), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Strategies, Illumination,
                         testing::Values(Case{WeightStrategy::kUniform, 1.0F, "UniformGoodLight"},
                                         Case{WeightStrategy::kGradient, 1.0F, "GradientGoodLight"},
                                         Case{WeightStrategy::kWindow, 1.0F, "WindowGoodLight"},
                                         Case{WeightStrategy::kUniform, 0.1F, "UniformLowLight"},
                                         Case{WeightStrategy::kGradient, 0.1F, "GradientLowLight"},
                                         Case{WeightStrategy::kWindow, 0.1F, "WindowLowLight"}),
                         [](const auto& one) { return std::string(one.param.name); });

// Equation (6) written out, sum by sum, for every pixel.
TEST(SmoothnessWeightsTest, WindowIsThatOfThePaper) {
  const FloatImage start = test::painted_target(37, 29, 0.8F);
  constexpr double kAlpha = 0.15, kWindowSigma_px = 1.3;
  SmoothnessSystem system;
  SmoothnessWeights().weigh(start, WeightStrategy::kWindow, kAlpha, kWindowSigma_px, system);
  const int radius = static_cast<int>(std::ceil(3.0 * kWindowSigma_px));
  double whole = 0.0;
  const auto gauss = [&](int x, int y) {
    return std::exp(-(x * x + y * y) / (2.0 * kWindowSigma_px * kWindowSigma_px));
  };
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) whole += gauss(x, y);
  }
  const auto across = [&](int u, int v) {
    if (u + 1 >= start.width_px) return 0.0;
    return static_cast<double>(start.view().at(u + 1, v)) - static_cast<double>(start.view().at(u, v));
  };
  constexpr auto kEps = static_cast<double>(kFlat);
  for (int v = 0; v < start.height_px; ++v) {
    for (int u = 0; u + 1 < start.width_px; ++u) {
      double fraction = 0.0, gathered = 0.0;
      for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
          if (!start.view().contains(u + x, v + y)) continue;
          fraction += gauss(x, y) / whole;
          gathered += gauss(x, y) / whole * across(u + x, v + y);
        }
      }
      const double weight = fraction / (std::abs(gathered) + kEps);
      const double wanted = kAlpha * weight / (std::abs(across(u, v)) + kEps);
      const auto found = static_cast<double>(system.right[static_cast<std::size_t>(v * start.width_px + u)]);
      ASSERT_NEAR(found, wanted, 2e-3 * wanted) << u << ' ' << v;
    }
  }
}

TEST(SmoothnessSolverTest, EvenLightStaysAsItIs) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 3}, {33, 5}}) {
    FloatImage start;
    start.shape(width, height, 1);
    std::fill(start.values.begin(), start.values.end(), 0.25F);
    SmoothnessSystem system;
    SmoothnessWeights().weigh(start, WeightStrategy::kWindow, 0.15, 2.0, system);
    FloatImage refined;
    SmoothnessSolver().solve(system, start, kTolerance, kMax, refined);
    for (const float value : refined.values) EXPECT_NEAR(value, 0.25F, 1e-4F) << width << 'x' << height;
  }
}

// The sum of (5)'s equations: links cancel, so that the mean is preserved.
TEST(SmoothnessSolverTest, KeepsTheSumOfLight) {
  const FloatImage start = test::painted_target(120, 90, 0.5F);
  SmoothnessSystem system;
  SmoothnessWeights().weigh(start, WeightStrategy::kWindow, 0.15, 2.0, system);
  FloatImage refined;
  SmoothnessSolver().solve(system, start, kTolerance, kMax, refined);
  double before = 0.0, after = 0.0;
  for (const float value : start.values) before += static_cast<double>(value);
  for (const float value : refined.values) after += static_cast<double>(value);
  EXPECT_NEAR(after, before, 2e-3 * before);
}

}  // namespace
}  // namespace pharos::enhance
