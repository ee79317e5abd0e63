// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/low_light/published_methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/evaluation/low_light/plane.hpp"

namespace pharos::tools {
namespace {

constexpr int kWidth = 192, kHeight = 128;

// A dim square, a ramp of 8 to 23, before black.
GreyBytes dim_square() {
  GreyBytes image(static_cast<std::size_t>(kWidth * kHeight), 0);
  for (int v = 32; v < 96; ++v) {
    for (int u = 64; u < 128; ++u) {
      image[static_cast<std::size_t>(v * kWidth + u)] = static_cast<std::uint8_t>(8 + (u - 64 + v - 32) / 8);
    }
  }
  return image;
}

double mean_in_square(const GreyBytes& image) {
  double sum = 0.0;
  for (int v = 40; v < 88; ++v) {
    for (int u = 72; u < 120; ++u) sum += image[static_cast<std::size_t>(v * kWidth + u)];
  }
  return sum / (48.0 * 48.0);
}

TEST(PublishedMethods, BrightenADimTarget) {
  const GreyBytes image = dim_square();
  for (const auto& method : {msrcr, dong, bimef, srie}) {
    const GreyBytes bright = method(image, kWidth, kHeight);
    ASSERT_EQ(bright.size(), image.size());
    EXPECT_GT(mean_in_square(bright), 1.5 * mean_in_square(image));
  }
}

// The glow that paper 004 sees in its figure 4: MSRCR darkens the black beside the target, so far black is grey.
TEST(PublishedMethods, OnlyMsrcrLiftsTheBlackAwayFromTheTarget) {
  const GreyBytes image = dim_square();
  const auto corner = [&image](auto method) { return int{method(image, kWidth, kHeight).front()}; };
  EXPECT_GT(corner(msrcr), 20);
  for (const auto& method : {dong, bimef}) EXPECT_LE(corner(method), 2);
}

TEST(PublishedMethods, LeaveAWhiteImageWhite) {
  const GreyBytes white(static_cast<std::size_t>(kWidth * kHeight), 255);
  for (const auto& method : {dong, bimef, srie}) EXPECT_GE(mean_in_square(method(white, kWidth, kHeight)), 250.0);
}

// The normal equation (I + D^T W D) x = data holds: the residual is orthogonal to nothing larger than the tolerance,
// and the sum is kept, as every difference leaves it alone.
TEST(PublishedMethods, SmoothestSolvesItsNormalEquation) {
  Plane data(24, 16);
  for (std::size_t i = 0; i < data.values.size(); ++i) data.values[i] = std::sin(0.7 * static_cast<double>(i));
  const Gradient weights{Plane(24, 16, 3.0), Plane(24, 16, 5.0)};
  const Plane x = smoothest(data, weights, data, {1e-10, 1000});
  double worst = 0.0;
  for (int v = 0; v < 16; ++v) {
    for (int u = 0; u < 24; ++u) {
      double left = x.at(u, v);
      if (u > 0) left += 3.0 * (x.at(u, v) - x.at(u - 1, v));
      if (u < 23) left += 3.0 * (x.at(u, v) - x.at(u + 1, v));
      if (v > 0) left += 5.0 * (x.at(u, v) - x.at(u, v - 1));
      if (v < 15) left += 5.0 * (x.at(u, v) - x.at(u, v + 1));
      worst = std::max(worst, std::abs(left - data.at(u, v)));
    }
  }
  EXPECT_LT(worst, 1e-8);
  const auto sum = [](const Plane& p) { return std::accumulate(p.values.begin(), p.values.end(), 0.0); };
  EXPECT_NEAR(sum(x), sum(data), 1e-8);
}

}  // namespace
}  // namespace pharos::tools
