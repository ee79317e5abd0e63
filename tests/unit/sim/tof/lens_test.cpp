// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

TEST(Lens, EveryPixelsRayComesBackToThePixel) {
  const Lens lens{LensModel{}};
  double worst = 0.0;
  for (int v = -1; v <= 480; v += 13) {
    for (int u = -1; u <= 640; u += 13) {
      const Vector2 ray = lens.ray(u, v);
      worst = std::max(worst, (lens.project(2.5 * Vector3(ray.x(), ray.y(), 1.0)) - Vector2(u, v)).norm());
    }
  }
  EXPECT_LT(worst, 1e-8);
}

TEST(Lens, ProjectsAsThePublishedFormulaByHand) {
  // x = 0.3, y = -0.2: r2 = 0.13, radial = 1 - 0.1991 * 0.13 + 0.0809 * 0.0169 = 0.97548421.
  const double x = 0.3 * 0.97548421 + 2 * 0.0021 * 0.3 * -0.2 - 0.0002 * (0.13 + 2 * 0.09);
  const double y = -0.2 * 0.97548421 + 0.0021 * (0.13 + 2 * 0.04) - 2 * 0.0002 * 0.3 * -0.2;
  const Vector2 pixel = Lens(LensModel{}).project({0.6, -0.4, 2.0});
  EXPECT_NEAR(pixel.x(), 608.61 * x + 321.85, 1e-6);
  EXPECT_NEAR(pixel.y(), 605.04 * y + 238.94, 1e-6);
}

TEST(Lens, SlopeIsWhatNeighbouringRaysDifferBy) {
  const Lens lens{LensModel{}};
  const Vector2 predicted = lens.ray(600, 40) + lens.slope(600, 40) * Vector2(0.5, -0.5);
  const Vector2 pixel = lens.project({predicted.x(), predicted.y(), 1.0});
  EXPECT_NEAR(pixel.x(), 600.5, 1e-3);
  EXPECT_NEAR(pixel.y(), 39.5, 1e-3);
}

TEST(Lens, RefusesADistortionThatFoldsThePicture) {
  LensModel model;
  model.distortion = {-1.5, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(Lens{model}, host::InputError);
}

}  // namespace
}  // namespace pharos::sim
