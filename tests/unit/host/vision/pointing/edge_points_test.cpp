// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/edge_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/images/grey_image.hpp"

namespace pharos::pointing {
namespace {

constexpr double kEdgeBlur_px = 0.9;

// Fraction of what begins at a place, `off_px` beyond it.
double rise(double off_px) { return 0.5 * std::erfc(-off_px / (kEdgeBlur_px * std::sqrt(2.0))); }

// A panel 360 px long and 100 px wide. A bright line runs along its first side, 5 px inside.
struct LinedPanel {
  Segment first{Vector2(340.0, 420.0), Vector2(190.0, 95.0)};

  double light(const Vector2& place) const {
    const double in = first.offset(place), at = first.station(place);
    const double cells = 44.0 + 14.0 * std::sin(at);
    const double across = cells * (rise(in) - rise(in - 100.0)) + 90.0 * (rise(in - 5.0) - rise(in - 7.0));
    return across * rise(at) * rise(first.length() - at);
  }
  host::GreyImage image() const {
    host::GreyImage image{512, 512, 16, {}};
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(0.0, 60.0);
    for (int v = 0; v < image.height_px; ++v) {
      for (int u = 0; u < image.width_px; ++u) {
        const double value = 300.0 + 257.0 * light(Vector2(u, v)) + noise(random);
        image.pixels.push_back(static_cast<std::uint16_t>(std::clamp(value, 0.0, 65535.0)));
      }
    }
    return image;
  }
};

// Over long profiles the rise that fits best is a wide one, up to the line; few rows have it near the edge (3.7 deg off
// at a stated 0.7, seed 480001 of the campaign).
TEST(EdgePoints, AreOnTheRiseBeforeABrightLine) {
  const LinedPanel panel;
  const host::GreyImage image = panel.image();
  const auto target = find_target(image.view());
  ASSERT_TRUE(target.ok());
  const MeasuredEdge edge = measure_edge(image.view(), *target, panel.first, 45.0);
  EXPECT_GT(edge.points.size(), 200U);
  double mean_px = 0.0;
  for (const EdgePoint& point : edge.points) {
    mean_px += panel.first.offset(point.place_px) / static_cast<double>(edge.points.size());
  }
  EXPECT_LT(std::abs(mean_px), 0.15);
}

}  // namespace
}  // namespace pharos::pointing
