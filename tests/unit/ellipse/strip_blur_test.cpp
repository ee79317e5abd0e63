// SPDX-License-Identifier: Apache-2.0
// Narrow rings by another blur than the assumed one: out of focus, or moved during the exposure.
#include "pharos/ellipse/strip_blur.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pharos/ellipse/close_edges.hpp"
#include "pharos/ellipse/refine_fit.hpp"
#include "tests/unit/ellipse/ring_frames.hpp"
#include "tools/evaluation/problems/drawn_ellipses.hpp"

namespace pharos::ellipse {
namespace {

using test::TrueEllipse;

constexpr int kRingSide_px = 100;
constexpr int kRings = 40;
constexpr double kRingTolerance_px = 0.25;

struct NarrowRing {
  TrueEllipse outer, inner;
  std::vector<DetectedEllipse> found;
};

// A ring 2.5 to 4 px wide; `moved_px`: how far the picture moves to the right during the exposure.
NarrowRing narrow_ring(std::uint64_t seed, double blur_px, double moved_px) {
  constexpr int kMoments = 9;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double b = uniform(15.0, 30.0), a = b * uniform(1.0, 1.3), width = uniform(2.5, 4.0);
  NarrowRing ring;
  ring.outer = {uniform(49.5, 50.5), uniform(49.5, 50.5), a, b, uniform(-1.5, 1.5)};
  ring.inner = ring.outer;
  ring.inner.a_px -= width;
  ring.inner.b_px -= width;
  test::Imaging imaging;
  imaging.blur_px = blur_px;
  std::vector<double> sum(static_cast<std::size_t>(kRingSide_px * kRingSide_px));
  for (int k = 0; k < kMoments; ++k) {
    test::Drawing drawing(kRingSide_px, kRingSide_px, 0.2);
    const double off = moved_px * ((k + 0.5) / kMoments - 0.5);
    for (const auto& [edge, value] : {std::pair(ring.outer, 0.8), std::pair(ring.inner, 0.2)}) {
      TrueEllipse there = edge;
      there.cx_px += off;
      drawing.fill(there, value);
    }
    const std::vector<std::uint16_t> pixels = drawing.image(imaging, random);
    std::transform(pixels.begin(), pixels.end(), sum.begin(), sum.begin(), [](auto p, double s) { return s + p; });
  }
  std::vector<std::uint16_t> pixels(sum.size());
  std::transform(sum.begin(), sum.end(), pixels.begin(),
                 [](double s) { return static_cast<std::uint16_t>(std::lround(s / kMoments)); });
  Bench bench(pixels.size());
  bench.detect(pixels, kRingSide_px, kRingSide_px);
  ring.found = {bench.workspace->found.begin(), bench.workspace->found.end()};
  return ring;
}

struct AxesOff {
  int reported = 0, beyond_tolerance = 0, beyond_sigmas = 0;
  double mean_sigma_px = 0.0;
};
AxesOff axes_off(double blur_px, double moved_px) {
  AxesOff off;
  for (std::uint64_t seed = 1; seed <= kRings; ++seed) {
    const NarrowRing ring = narrow_ring(seed, blur_px, moved_px);
    if (ring.found.size() != 2) continue;
    for (const DetectedEllipse& found : ring.found) {
      const TrueEllipse& truth = found.bright_inside ? ring.outer : ring.inner;
      const double error = std::hypot(found.ellipse.a_px - truth.a_px, found.ellipse.b_px - truth.b_px);
      const double sigma = std::sqrt(found.covariance(2, 2) + found.covariance(3, 3));
      ++off.reported;
      off.beyond_tolerance += error > kRingTolerance_px ? 1 : 0;
      off.beyond_sigmas += error > std::max(kRingTolerance_px, 5.0 * sigma) ? 1 : 0;
      off.mean_sigma_px += sigma / (2.0 * kRings);
    }
  }
  return off;
}

TEST(StripBlurs, HalfWidthsAreThoseOfTheAssumedBlurAsWell) {
  for (const double seen : {1.6, 1.8, 2.0, 2.3}) {
    EXPECT_NEAR(half_width_of_strip(seen, kFlankVariance_px2), strip_of(seen).half_px, 2e-3) << seen;
  }
  EXPECT_EQ(half_width_of_strip(1.4, 2.0), 0.0);
  EXPECT_NEAR(half_width_of_strip(6.0, 2.0), 6.0, 1e-6);
}

TEST(StripBlurs, RingsOutOfFocusAreWithinTheirSigmas) {
  for (const double blur_px : {1.2, 1.4}) {
    const AxesOff off = axes_off(blur_px, 0.0);
    EXPECT_GT(off.reported, kRings) << blur_px;
    EXPECT_GT(off.beyond_tolerance, off.reported / 4) << blur_px;
    EXPECT_EQ(off.beyond_sigmas, 0) << blur_px;
  }
}

// A motion's blur ends more abruptly than a lens', so that it is told too small: 49 of 80 without its measurement.
TEST(StripBlurs, OfRingsThatMoveOneInTwentyIsBeyondItsSigmas) {
  const AxesOff off = axes_off(0.7, 4.0);
  EXPECT_GT(off.reported, kRings);
  EXPECT_GT(off.beyond_tolerance, off.reported / 4);
  EXPECT_LE(off.beyond_sigmas, off.reported / 20);
}

// Where the blur is the assumed one its measurement costs little.
TEST(StripBlurs, RingsInFocusAreAsWellKnownAsTheLensLetsThem) {
  const AxesOff off = axes_off(0.7, 0.0);
  EXPECT_EQ(off.reported, 2 * kRings);
  EXPECT_LT(off.mean_sigma_px, 0.25);
}

TEST(StripBlurs, WithoutAnImageNothingIsTold) {
  const Bench bench(16);
  EXPECT_EQ(strip_errors({}, {}, *bench.workspace), (std::array<double, 2>{0.0, 0.0}));
}

}  // namespace
}  // namespace pharos::ellipse
