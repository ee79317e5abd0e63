// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ellipse_rows.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "pharos/tof/ransac_sampler.hpp"
#include "pharos/tof/sector_sums.hpp"

namespace pharos::tof {
namespace {

const ellipse::Ellipse kShape{50.3, 40.7, 30.0, 18.0, 0.4};

// (p - c)^T A (p - c), by rotation into the axes: below 1 inside.
double level(const ellipse::Ellipse& e, double u, double v) {
  const double du = u - e.cx_px, dv = v - e.cy_px;
  const double along = du * std::cos(e.theta_rad) + dv * std::sin(e.theta_rad);
  const double across = -du * std::sin(e.theta_rad) + dv * std::cos(e.theta_rad);
  return std::pow(along / e.a_px, 2) + std::pow(across / e.b_px, 2);
}

TEST(EllipseRows, CoverThePixelsInsideAndNoOthers) {
  const EllipseRows rows(kShape, 0.0);
  for (int v = 0; v < 100; ++v) {
    const PixelSpan span = rows.at(v, 120);
    for (int u = 0; u < 120; ++u) {
      if (std::abs(level(kShape, u, v) - 1.0) < 1e-9) continue;
      EXPECT_EQ(u >= span.first && u <= span.last, level(kShape, u, v) < 1.0) << u << ", " << v;
    }
  }
}

TEST(EllipseRows, GrowByTheirMarginAndStopAtTheImagesBorder) {
  EXPECT_NEAR(EllipseRows(kShape, 5.0).right_px() - EllipseRows(kShape, 0.0).right_px(), 5.0, 0.2);
  EXPECT_EQ(EllipseRows(kShape, 0.0).at(40, 55).last, 54);
  EXPECT_EQ(EllipseRows(kShape, 0.0).rows(45).last, 44);
  const PixelSpan above = EllipseRows(kShape, 0.0).at(1, 120);
  EXPECT_LT(above.last, above.first);
}

TEST(EllipseRows, BetweenTwoLieTheRingsPixels) {
  const ellipse::Ellipse inner{50.3, 40.7, 20.0, 12.0, 0.4};
  int pixels = 0;
  for_each_span_between(EllipseRows(inner, 0.0), EllipseRows(kShape, 0.0), 120, 100, [&](int v, PixelSpan span) {
    for (int u = span.first; u <= span.last; ++u, ++pixels) {
      EXPECT_LT(level(kShape, u, v), 1.0 + 1e-9);
      EXPECT_GT(level(inner, u, v), 1.0 - 1e-9);
    }
  });
  const double area = std::numbers::pi * (30.0 * 18.0 - 20.0 * 12.0);
  EXPECT_NEAR(pixels, area, 0.03 * area);
}

TEST(RansacSampler, DrawsEvenlyBelowTheCountAndTheSameEveryTime) {
  RansacSampler one, other;
  std::array<int, 7> drawn{};
  for (int i = 0; i < 7000; ++i) {
    const std::size_t k = one.below(7);
    ASSERT_LT(k, 7u);
    ASSERT_EQ(k, other.below(7));
    ++drawn[k];
  }
  for (const int count : drawn) EXPECT_NEAR(count, 1000, 120);
}

TEST(SectorSums, IndependentResidualsAreNotWidenedAndCommonOnesAre) {
  SectorSums independent, clustered;
  RansacSampler random;
  double common = 0.0;
  for (int i = 0; i < 6400; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 6400;
    const double residual = static_cast<double>(random.below(2001)) / 1000.0 - 1.0;
    if (i % 100 == 0) common = residual;  // one value a sector
    independent.add(std::cos(angle), std::sin(angle), 1.0, residual);
    clustered.add(std::cos(angle), std::sin(angle), 1.0, common);
  }
  EXPECT_EQ(independent.count(), 6400);
  EXPECT_NEAR(independent.variance(), 1.0 / 3.0, 0.02);
  EXPECT_LT(independent.variance_inflation(3), 1.8);
  EXPECT_GT(clustered.variance_inflation(3), 50.0);
}

TEST(SectorSums, WhereHardlyASectorIsSeenAllMayBeOneMeasurement) {
  SectorSums few;
  for (int i = 0; i < 40; ++i) few.add(1.0, 0.001 * i, 1.0, i % 2 == 0 ? 1.0 : -0.9);
  EXPECT_EQ(few.variance_inflation(3), 40.0);
  EXPECT_EQ(SectorSums().variance_inflation(3), 1.0);
}

}  // namespace
}  // namespace pharos::tof
