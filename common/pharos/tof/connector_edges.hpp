// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/raised_box.hpp"
#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

/// Position of the connector's face.
struct ConnectorFace {
  PlanarRectangle rectangle;
  double height_m = 0.0;  ///< over the ring's plane
  double sigma_height_m = 0.0;
  Matrix2 covariance = Matrix2::Zero();  ///< of the centre, in the ring's plane, m^2
  double common_variance_m2 = 0.0;       ///< of it, in every direction: what frames of one view share
  double edge_rms_px = 0.0;              ///< deviation of one pixel at an edge, as a displacement of it
  std::int32_t edge_points = 0;          ///< pixels used; 0: the fit failed
  /// Light at the corners away from walls in sight: 1 a rectangle's, 0 that of a disc as large; and its deviation.
  double squareness = 1.0, sigma_squareness = 1e9;

  /// A thruster's rim, a cap: no connector's top, as far as so few pixels tell.
  bool is_round() const { return squareness + 2.0 * sigma_squareness < 0.5; }
  /// And no thruster's.
  bool is_square() const { return squareness > 0.5 && squareness > 2.0 * sigma_squareness; }
};

/// Fits a rectangle to the pixels about the sides of a raised box.
///
/// Observed is each pixel's layer intensity, amplitude x (height - base) / (top - base): the light that comes from the
/// top, linear in the part of the pixel that the top covers (depths mix weighted by amplitude), whatever the brightness
/// of what lies beside it. Model: the rectangle's area within the pixel, blurred, and the upright walls in sight, whose
/// part falls linearly to zero at their foot. Unknowns are centre, turn, sides, the top's brightness and the walls'
/// brightness over it, the latter with that of the ring's walls as prior; robust Gauss-Newton. The top's inner part is
/// left out: it may have any pattern.
///
/// `edge_points` is 0 where that does not converge to a rectangle near the box: centre and deviation are then those of
/// the box in the depths.
ConnectorFace fit_face(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const RaisedBox& box);

}  // namespace pharos::tof
