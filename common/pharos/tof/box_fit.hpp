// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/planar_rectangle.hpp"
#include "pharos/tof/relief_grid.hpp"

namespace pharos::tof {

/// A rectangle of raised cells, as they are displaced in the ring's plane.
struct BoxFit {
  PlanarRectangle rectangle;
  double height_m = 0.0;
  double base_m = 0.0;
  /// Sum over the rectangle's cells of weight x vote; the vote goes from -1 at the plate to 1 at the top.
  double votes = 0.0;
  double agreement = 0.0;  ///< mean vote

  double step_m() const { return height_m - base_m; }
};

/// What a fit starts from.
struct BoxSeed {
  int column = 0;
  int row = 0;
  double height_m = 0.0;  ///< of the top, about
  double base_m = 0.0;
  double noise_m = 0.0;  ///< of a cell's height, times the root of its weight
  /// Displacement in the ring's plane of what stands a metre over it: where walls appear.
  Vector2 wall_slope = Vector2::Zero();
};

/// The most probable box about a seed: every cell votes r (2 x - r) with its height x over the plate in units of the
/// step and the height r that the box has there, 1 on its top, falling to 0 along the walls in sight; the logarithm of
/// the likelihood of the box over that of the plate is step^2 / (2 noise^2) x the sum of weight x vote. Sides move one
/// by one, so that a bar is found from a square seed; a connector's nearly equal sides are the prior.
BoxFit fit_box(const ReliefGrid& grid, const BoxSeed& seed);

/// What lies beyond a box's sides.
struct BoxSides {
  double plate_log_odds = 0.0;  ///< that it is the plate, over the top's going on; all sides together
  int level = 0;                ///< something as high as the top
  int hidden = 0;               ///< something before the satellite, that may hide a part of the box
  int unknown = 0;              ///< nothing was measured
};
/// `noise_m` and `wall_slope` as in BoxSeed. Sides that the camera sees show the
/// box' own wall first, which is passed over.
BoxSides sides_of(const ReliefGrid& grid, const BoxFit& fit, double noise_m, const Vector2& wall_slope);

}  // namespace pharos::tof
