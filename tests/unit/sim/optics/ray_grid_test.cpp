// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/ray_grid.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

// The paper's lens with a quarter of the pixels in each direction.
constexpr Lens kSmall{160, 120, 152.15, 151.26, 80.46, 59.74, kPaperLens.distortion};

// Largest distance of the grid's points from the projections of their rays.
double worst_miss(const RayGrid& grid, double first_px, double step_px) {
  double worst = 0.0;
  for (int row = 0; row < grid.rows(); row += 7) {
    for (int column = 0; column < grid.columns(); column += 7) {
      const Vector2 point(first_px + column * step_px, first_px + row * step_px);
      worst = std::max(worst, (pixel_of(kSmall, grid.at(column, row)) - point).norm());
    }
  }
  return worst;
}

TEST(RayGrid, RaysArriveAtThePixelsCentresAndABorder) {
  const RayGrid grid = RayGrid::pixel_centres(kSmall, 1);
  EXPECT_EQ(grid.columns(), 162);
  EXPECT_EQ(grid.rows(), 122);
  EXPECT_LT(worst_miss(grid, -1.0, 1.0), 1e-12);
}

TEST(RayGrid, RaysArriveAtThePixelsCorners) {
  const RayGrid grid = RayGrid::pixel_corners(kSmall);
  EXPECT_EQ(grid.columns(), 161);
  EXPECT_LT(worst_miss(grid, -0.5, 1.0), 1e-12);
}

TEST(RayGrid, RaysInsideAPixelAreSpreadEvenlyAboutItsCentre) {
  const RayGrid grid = RayGrid::inside_pixels(kSmall, 4);
  EXPECT_EQ(grid.rows(), 480);
  EXPECT_LT(worst_miss(grid, -0.375, 0.25), 1e-12);
}

TEST(RayGrid, RefusesADistortionThatFoldsThePicture) {
  Lens lens = kPaperLens;
  lens.distortion = {-1.5, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(RayGrid::pixel_centres(lens, 0), host::InputError);
}

}  // namespace
}  // namespace pharos::sim
