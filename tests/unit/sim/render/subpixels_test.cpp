// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/render/subpixels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace pharos::sim {
namespace {

struct Spread {
  std::array<double, 2> mean{}, variance{};
};

template <typename Places>
Spread spread_of(const Places& places) {
  Spread moments;
  const auto count = static_cast<double>(places.size());
  for (const Subpixel& place : places) {
    for (std::size_t k = 0; k < 2; ++k) {
      moments.mean[k] += place[k] / count;
      moments.variance[k] += place[k] * place[k] / count;
    }
  }
  return moments;
}

TEST(HammersleySubpixels, HaveEveryColumnAndRowOnce) {
  std::set<double> columns, rows;
  for (const Subpixel& place : kHammersleySubpixels) {
    columns.insert(place[0]);
    rows.insert(place[1]);
    EXPECT_LT(std::abs(place[0]), 0.5);
    EXPECT_LT(std::abs(place[1]), 0.5);
  }
  EXPECT_EQ(columns.size(), 16u);
  EXPECT_EQ(rows.size(), 16u);
  EXPECT_NEAR(spread_of(kHammersleySubpixels).mean[0], 0.0, 1e-15);
  EXPECT_NEAR(spread_of(kHammersleySubpixels).mean[1], 0.0, 1e-15);
}

TEST(BlurredSubpixels, AreSpreadAsPixelAndOpticsTogether) {
  for (const double blur_px : {0.0, 0.5, 1.2}) {
    const Spread moments = spread_of(blurred_subpixels(1024, blur_px));
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(moments.mean[k], 0.0, 1e-15);
      EXPECT_NEAR(moments.variance[k], blur_px * blur_px + 1.0 / 12.0,
                  0.02 * (blur_px * blur_px + 1.0 / 12.0));  // 1024 samples
    }
  }
}

TEST(BlurredSubpixels, CoverAnEdgeAsTheBlurredStepAcrossIt) {
  // The fraction of samples left of a vertical edge, compared with the error function averaged over the pixel.
  const double blur_px = 0.5;
  const auto places = blurred_subpixels(1024, blur_px);
  for (const double edge : {-0.6, -0.2, 0.0, 0.3, 0.7}) {
    double left = 0.0;
    for (const Subpixel& place : places) left += place[0] < edge ? 1.0 / 1024.0 : 0.0;
    double expected = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double inside = (i + 0.5) / 1000.0 - 0.5;
      expected += 0.5 * std::erfc((inside - edge) / (blur_px * std::sqrt(2.0))) / 1000.0;
    }
    EXPECT_NEAR(left, expected, 0.003);
  }
}

TEST(BlurredSubpixels, StayWithinTheirReach) {
  for (const Subpixel& place : blurred_subpixels(1024, 0.7)) {
    EXPECT_LE(std::max(std::abs(place[0]), std::abs(place[1])), blurred_subpixel_reach(0.7));
  }
}

}  // namespace
}  // namespace pharos::sim
