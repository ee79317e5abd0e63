// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/ray_grid.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

// Largest distance of the grid's points from where their rays arrive.
double worst_miss(const RayGrid& grid, double first_px, double step_px) {
  double worst = 0.0;
  for (int row = 0; row < grid.rows(); row += 7) {
    for (int column = 0; column < grid.columns(); column += 7) {
      const Vector2 point(first_px + column * step_px, first_px + row * step_px);
      worst = std::max(worst, (pixel_of(kPaperLens, grid.at(column, row)) - point).norm());
    }
  }
  return worst;
}

TEST(RayGrid, RaysArriveAtThePixelsCentresAndABorder) {
  const RayGrid grid = RayGrid::pixel_centres(kPaperLens, 1);
  EXPECT_EQ(grid.columns(), 642);
  EXPECT_EQ(grid.rows(), 482);
  EXPECT_LT(worst_miss(grid, -1.0, 1.0), 1e-12);
}

TEST(RayGrid, RaysArriveAtThePixelsCorners) {
  const RayGrid grid = RayGrid::pixel_corners(kPaperLens);
  EXPECT_EQ(grid.columns(), 641);
  EXPECT_LT(worst_miss(grid, -0.5, 1.0), 1e-12);
}

TEST(RayGrid, RaysInsideAPixelAreSpreadEvenlyAboutItsCentre) {
  const RayGrid grid = RayGrid::inside_pixels(kPaperLens, 4);
  EXPECT_EQ(grid.rows(), 1920);
  EXPECT_LT(worst_miss(grid, -0.375, 0.25), 1e-12);
}

TEST(RayGrid, RefusesADistortionThatFoldsThePicture) {
  Lens lens = kPaperLens;
  lens.distortion = {-1.5, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(RayGrid::pixel_centres(lens, 0), host::InputError);
}

}  // namespace
}  // namespace pharos::sim
