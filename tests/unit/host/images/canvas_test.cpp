// SPDX-License-Identifier: Apache-2.0
#include "host/images/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace pharos::host {
namespace {

constexpr int kSide = 64, kZoom = 2;

Canvas dark_canvas() {
  const std::vector<std::uint16_t> pixels(kSide * kSide, 0);
  return {{pixels.data(), kSide, kSide}, kZoom};
}

bool is(Colour one, Colour other) { return one.red == other.red && one.green == other.green && one.blue == other.blue; }

int painted(const Canvas& canvas) {
  int count = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) count += is(canvas.pixel(x, y), colours::kBlack) ? 0 : 1;
  }
  return count;
}

TEST(Canvas, ALineRunsThroughPixelCentres) {
  Canvas canvas = dark_canvas();
  canvas.line({10.0, 20.0}, {30.0, 20.0}, colours::kWhite, 2.0);
  EXPECT_TRUE(is(canvas.pixel(2 * 20, 2 * 20), colours::kWhite));  // the two picture pixels of row 20
  EXPECT_TRUE(is(canvas.pixel(2 * 20 + 1, 2 * 20 + 1), colours::kWhite));
  EXPECT_TRUE(is(canvas.pixel(2 * 20, 2 * 20 + 4), colours::kBlack));
  EXPECT_TRUE(is(canvas.pixel(2 * 40, 2 * 20), colours::kBlack));
}

TEST(Canvas, AnEllipseHasItsAxes) {
  Canvas canvas = dark_canvas();
  canvas.ellipse({32.0, 32.0}, 20.0, 10.0, 0.0, colours::kRed, 3.0);
  EXPECT_TRUE(is(canvas.pixel(2 * 52, 2 * 32), colours::kRed));
  EXPECT_TRUE(is(canvas.pixel(2 * 32, 2 * 42), colours::kRed));
  EXPECT_TRUE(is(canvas.pixel(2 * 32, 2 * 32), colours::kBlack));
  EXPECT_TRUE(is(canvas.pixel(2 * 32, 2 * 52), colours::kBlack));
}

TEST(Canvas, WordsAreSeenAndCutAtTheBorder) {
  Canvas canvas = dark_canvas();
  canvas.text({5.0, 5.0}, "No 7", colours::kWhite, 1);
  const int whole = painted(canvas);
  EXPECT_GT(whole, 20);
  canvas.text({60.0, 60.0}, "beyond", colours::kWhite, 3);
  EXPECT_GT(painted(canvas), whole);
}

TEST(Canvas, PlacesFarOutsideOrNowhereDrawNothing) {
  Canvas canvas = dark_canvas();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  canvas.line({-500.0, -500.0}, {-400.0, 900.0}, colours::kWhite);
  canvas.line({kNan, 1.0}, {5.0, 5.0}, colours::kWhite);
  canvas.ellipse({1e9, 1e9}, 1e9, 1e9, 0.0, colours::kWhite);
  canvas.ellipse({kNan, 0.0}, 10.0, 5.0, 0.0, colours::kWhite);
  canvas.text({1e12, kNan}, "x", colours::kWhite);
  canvas.dot({-3.0, -3.0}, colours::kWhite);
  canvas.cross({1e300, 0.0}, colours::kWhite);
  canvas.arrow({5.0, 5.0}, {5.0, kNan}, colours::kWhite);
  canvas.tint(-1, 900, colours::kWhite, 1.0);
  EXPECT_EQ(painted(canvas), 0);
}

TEST(Canvas, StretchesTheGreyGround) {
  std::vector<std::uint16_t> pixels(kSide * kSide);
  for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = static_cast<std::uint16_t>(1000 + k % kSide);
  const Canvas canvas({pixels.data(), kSide, kSide}, 1);
  EXPECT_LT(canvas.pixel(0, 0).red, 10);
  EXPECT_GT(canvas.pixel(kSide - 1, 0).red, 190);
}

}  // namespace
}  // namespace pharos::host
