// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pharos::sim {
namespace {

// All five terms, tangential ones large enough to have an effect.
constexpr Lens kStrong{640, 480, 500.0, 520.0, 310.0, 250.0, {-0.21, 0.09, 0.006, -0.004, -0.01}};

TEST(Lens, ProjectsAsThePublishedFormulaByHand) {
  // x = 0.3, y = -0.2: r2 = 0.13, radial = 1 - 0.1991 * 0.13 + 0.0809 * 0.0169 = 0.97548421.
  const double x = 0.3 * 0.97548421 + 2 * 0.0021 * 0.3 * -0.2 - 0.0002 * (0.13 + 2 * 0.09);
  const double y = -0.2 * 0.97548421 + 0.0021 * (0.13 + 2 * 0.04) - 2 * 0.0002 * 0.3 * -0.2;
  const Vector2 pixel = pixel_of(kPaperLens, Vector3(0.6, -0.4, 2.0));
  EXPECT_NEAR(pixel.x(), 608.61 * x + 321.85, 1e-6);
  EXPECT_NEAR(pixel.y(), 605.04 * y + 238.94, 1e-6);
}

TEST(Lens, TheInverseComesBackToTheRay) {
  for (const Lens& lens : {kPaperLens, kStrong}) {
    double worst = 0.0;
    for (double y = -0.45; y <= 0.45; y += 0.05) {
      for (double x = -0.6; x <= 0.6; x += 0.05) {
        const Vector2 seen = distorted(lens, {x, y});
        const auto ray = undistorted(lens, seen, seen);
        ASSERT_TRUE(ray) << x << ", " << y;
        worst = std::max(worst, (*ray - Vector2(x, y)).norm());
      }
    }
    EXPECT_LT(worst, 1e-14);
  }
}

TEST(Lens, TheInverseDoesNotDependOnWhereItStarts) {
  const Vector2 seen = distorted(kStrong, {0.5, -0.4});
  const auto near = undistorted(kStrong, seen, {0.501, -0.399});
  const auto far = undistorted(kStrong, seen, Vector2::Zero());
  ASSERT_TRUE(near && far);
  EXPECT_LT((*near - *far).norm(), 1e-15);
}

TEST(Lens, WithoutDistortionTheInverseIsExact) {
  const Vector2 seen(0.123456789, -0.3);
  EXPECT_EQ(undistorted(centred_lens(640, 480, 600.0), seen, Vector2::Zero()), seen);
}

TEST(Lens, NoRayArrivesBeyondTheFold) {
  // r (1 - r2 / 3) has its largest value, 2/3, at r = 1.
  Lens lens = centred_lens(640, 480, 600.0);
  lens.distortion[0] = -1.0 / 3.0;
  EXPECT_TRUE(undistorted(lens, {0.6, 0.0}, {0.6, 0.0}));
  EXPECT_FALSE(undistorted(lens, {0.67, 0.0}, {0.67, 0.0}));
}

TEST(Lens, OfAnotherTypeOfCameraHasTheSameNumbers) {
  struct Other {
    std::int32_t width_px, height_px;
    double fx_px, fy_px, cx_px, cy_px;
    std::array<double, 5> distortion;
  };
  const Lens back = lens_of(optics_as<Other>(kStrong));
  EXPECT_EQ(back.width_px, kStrong.width_px);
  EXPECT_EQ(back.fy_px, kStrong.fy_px);
  EXPECT_EQ(back.cx_px, kStrong.cx_px);
  EXPECT_EQ(back.distortion, kStrong.distortion);
}

}  // namespace
}  // namespace pharos::sim
