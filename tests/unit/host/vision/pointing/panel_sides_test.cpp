// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "host/images/grey_image.hpp"

namespace pharos::pointing {
namespace {

constexpr double kStepBlur_px = 1.2;
constexpr double kPanel_px = 100.0, kBody_px = 98.0;  // columns of two edges in line
constexpr double kTop_px = 40.0, kPanelsEnd_px = 320.0, kBodysEnd_px = 430.0;

const PinholeCamera kCamera{320, 512, 600.0, 600.0, 159.5, 255.5, {}};

double blurred_step(double off_px) { return 0.5 * std::erfc(-off_px / (kStepBlur_px * std::sqrt(2.0))); }

// Lines between a panel's cells meet its side aslant and move the rise to and fro by 0.6 px.
double edge_at(double v) {
  return v > kPanelsEnd_px ? kBody_px : kPanel_px + 0.6 * std::sin(2.0 * std::numbers::pi * v / 11.0);
}

template <class EdgeAt>
host::GreyImage target_right_of(const EdgeAt& edge_at) {
  host::GreyImage image{320, 512, 16, {}};
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      const double across = blurred_step(u - edge_at(v)) * blurred_step(240.0 - u);
      image.pixels.push_back(static_cast<std::uint16_t>(300.0 + 20000.0 * across * blurred_step(v - kTop_px) *
                                                                    blurred_step(kBodysEnd_px - v)));
    }
  }
  return image;
}

// The line along both edges passes from one side of the panel's rises to the other; those that are far from it were
// missing, so that the panel's side was turned (seed 494127 of the campaign, 2.0 deg off at a stated 0.37).
TEST(MeasuredSide, OfTwoEdgesInLineIsOneAsAWhole) {
  const host::GreyImage image = target_right_of(edge_at);
  const auto target = find_target(image.view());
  ASSERT_TRUE(target.ok());
  const Segment both{Vector2(97.4, kBodysEnd_px), Vector2(100.6, kTop_px)};
  const auto side = measured_side(image.view(), *target, kCamera, both, 45.0);
  ASSERT_TRUE(side.ok());
  EXPECT_GT(side->fit.length_px(), 250.0);
  EXPECT_NEAR(side->fit.begin_px.x(), kPanel_px, 0.05);
  EXPECT_NEAR(side->fit.end_px.x(), kPanel_px, 0.05);
}

// Behind a part of a side is a face in the dark. Grey values that are no multiple of the light move the edge there by
// another fraction of its blur (seed 495059 of the campaign with gamma 0.5, 6.8 deg off at a stated 0.77).
TEST(MeasuredSide, OfAnEdgeWithAStepIsItsLongerPart) {
  constexpr double kStep_px = 0.3, kStepAt_px = 270.0;
  const host::GreyImage image =
      target_right_of([&](double v) { return v > kStepAt_px ? kPanel_px + kStep_px : kPanel_px; });
  const auto target = find_target(image.view());
  ASSERT_TRUE(target.ok());
  const Segment guess{Vector2(kPanel_px, kBodysEnd_px), Vector2(kPanel_px, kTop_px)};
  const auto side = measured_side(image.view(), *target, kCamera, guess, 45.0);
  ASSERT_TRUE(side.ok());
  EXPECT_GT(side->fit.length_px(), 200.0);
  EXPECT_NEAR(side->fit.begin_px.x(), kPanel_px, 0.02);
  EXPECT_NEAR(side->fit.end_px.x(), kPanel_px, 0.02);
}

}  // namespace
}  // namespace pharos::pointing
