// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/tone_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/ellipse/ring_frames.hpp"
#include "tools/evaluation/problems/drawn_ellipses.hpp"

namespace pharos::ellipse {
namespace {

using test::TrueEllipse;

constexpr int kTonedSide_px = 100;
const TrueEllipse kTonedDisc{50.3, 49.8, 30.0, 20.0, 0.4};

struct DiscPicture {
  double ground = 0.0, disc = 0.8;
  double blur_px = 0.7;
  double power = 1.0;  // of the light: the grey values
};

// One disc before a plain ground, through a tone curve, as 8 bits hold it.
class Toned {
 public:
  explicit Toned(const DiscPicture& picture) {
    test::Drawing drawing(kTonedSide_px, kTonedSide_px, picture.ground);
    drawing.fill(kTonedDisc, picture.disc);
    test::Imaging imaging;
    imaging.blur_px = picture.blur_px;
    std::mt19937_64 random(1);
    pixels_ = drawing.image(imaging, random);
    for (std::uint16_t& pixel : pixels_) {
      pixel = static_cast<std::uint16_t>(257.0 * std::round(255.0 * std::pow(pixel / 65535.0, picture.power)));
    }
    bench_.detect(pixels_, kTonedSide_px, kTonedSide_px);
  }
  DetectedEllipse before() const { return only(); }
  DetectedEllipse widened() {
    add_tone_error({pixels_.data(), kTonedSide_px, kTonedSide_px}, *bench_.workspace);
    return only();
  }

 private:
  DetectedEllipse only() const {
    EXPECT_EQ(bench_.workspace->found.size(), 1U);
    return bench_.workspace->found.empty() ? DetectedEllipse{} : bench_.workspace->found[0];
  }

  std::vector<std::uint16_t> pixels_;
  Bench bench_{static_cast<std::size_t>(kTonedSide_px * kTonedSide_px)};
};

double sigma(const DetectedEllipse& found, int k) { return std::sqrt(found.covariance(k, k)); }
// Of both axes, as they grow together.
double growth_px(const DetectedEllipse& found) {
  return 0.5 * (found.ellipse.a_px - kTonedDisc.a_px + found.ellipse.b_px - kTonedDisc.b_px);
}

// P(x < 0.674490) = 0.75, P(x < 0.318639) = 0.625, P(x < 0.0627) = 0.525.
TEST(ToneErrors, ShiftIsTheQuantileOfTheHalfLevel) {
  EXPECT_NEAR(tone_shift(1.0), 0.674490, 1e-6);
  EXPECT_NEAR(tone_shift(0.5), 0.318639, 1e-3);
  EXPECT_NEAR(tone_shift(0.1), 0.062707, 1e-3);
  EXPECT_EQ(tone_shift(0.0), 0.0);
}

TEST(ToneErrors, WhatASquareRootDoesIsOneSigmaOfTheAxes) {
  for (const auto& [ground, disc] : {std::pair{0.0, 0.8}, {0.02, 0.8}, {0.2, 0.7}, {0.8, 0.05}, {0.9, 0.3}}) {
    for (const double blur_px : {0.5, 0.7, 1.0, 1.5}) {
      const double linear = growth_px(Toned({ground, disc, blur_px, 1.0}).before());
      const DetectedEllipse found = Toned({ground, disc, blur_px, 0.5}).widened();
      const double grown = growth_px(found) - linear;  // what the blur's own shift is not known to
      EXPECT_GT(grown * (disc - ground), 0.0) << ground << ' ' << blur_px;
      EXPECT_NEAR(std::fabs(grown) / sigma(found, 2), 1.0, 0.25) << ground << ' ' << blur_px;
      EXPECT_NEAR(std::fabs(grown) / sigma(found, 3), 1.0, 0.25) << ground << ' ' << blur_px;
    }
  }
}

// A contour that grows as a whole stays where it is.
TEST(ToneErrors, ThePlaceIsAsWellKnownAsBefore) {
  Toned picture({0.0, 0.8, 0.7, 0.5});
  const DetectedEllipse before = picture.before(), after = picture.widened();
  for (const int k : {0, 1, 4}) EXPECT_LT(sigma(after, k), 1.1 * sigma(before, k)) << k;
  EXPECT_EQ(after.ellipse.a_px, before.ellipse.a_px);
}

// Axes grow together: their difference is hardly less certain.
TEST(ToneErrors, AxesErrTogether) {
  const Matrix5 covariance = Toned({0.0, 0.8, 0.7, 0.5}).widened().covariance;
  EXPECT_GT(covariance(2, 3) / std::sqrt(covariance(2, 2) * covariance(3, 3)), 0.95);
}

TEST(ToneErrors, FaintStepsAreMovedLittle) {
  const DetectedEllipse found = Toned({0.6, 0.75, 0.7, 0.5}).widened();
  EXPECT_LT(sigma(found, 2), 0.1);
}

}  // namespace
}  // namespace pharos::ellipse
