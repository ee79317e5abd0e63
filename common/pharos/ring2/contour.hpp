// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/ellipse/detected_ellipse.hpp"

namespace pharos::ring2 {

using Matrix5 = ellipse::Matrix5;
using Vector5 = ellipse::Vector5;

/// A measured ellipse by its support function h(u) = c u + sqrt(u^T S u) over the contour's normal directions u.
///
/// Its parameters (cx, cy, Sxx, Sxy, Syy), px and px^2, have no singularity where the ellipse is a circle, as (a, b,
/// theta) have: information about direction is kept there.
struct Contour {
  ellipse::Ellipse ellipse;
  Vector2 centre_px = Vector2::Zero();
  Matrix2 shape_px2 = Matrix2::Identity();  ///< S = R diag(a^2, b^2) R^T
  Matrix2 inverse_shape = Matrix2::Identity();
  Matrix5 information = Matrix5::Zero();  ///< inverse covariance of the five parameters
  double sigma_px = 0.0;                  /// of one edge point; for display

  /// Position of a point near the contour relative to it.
  struct Offset {
    double distance_px = 0.0;           ///< along the normal, positive outside; exact to second order
    Vector2 normal = Vector2::UnitX();  ///< d distance / d point
    Vector5 slope = Vector5::Zero();    ///< of the contour's own displacement with the five parameters
  };
  Offset offset_of(const Vector2& point_px) const;
};

/// From an ellipse whose edge points have a deviation of `sigma_px` each across the contour and are evenly spread along
/// it, `points` in all: the information of a least-distance fit of such points.
Contour contour_of(const ellipse::Ellipse& ellipse, double sigma_px, double points);

/// From an ellipse of an image, by the detector's covariance. `systematic_px` is added to each point's deviation as a
/// part that more points do not reduce: lens, rim and light.
Contour contour_of(const ellipse::DetectedEllipse& detected, double systematic_px);

/// Whether its axes are positive and everything finite.
bool is_usable(const ellipse::Ellipse& ellipse);

}  // namespace pharos::ring2
