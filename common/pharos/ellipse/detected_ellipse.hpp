// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ellipse/matrix.hpp"

namespace pharos::ellipse {

/// One ellipse found, with its quality.
struct DetectedEllipse {
  Ellipse ellipse;
  /// Of (cx, cy, a, b, theta), px and rad. Near a circle theta is undefined: its variance is at most that of a uniform
  /// direction (pi^2 / 12) and it is uncorrelated then.
  Matrix5 covariance = Matrix5::Zero();
  double score = 0.0;   ///< F_val = S1 sqrt(S2 S3), (2)-(4) of paper 000: at most 1
  double rms_px = 0.0;  ///< of the edge points' distances from the contour
  /// Fraction of the contour, 0 to 1, along which edge points lie on it.
  double coverage = 0.0;
  float gradient = 0.0F;       ///< across the contour, root of the mean square; the unit is that of the smoothed image
  std::int32_t points = 0;     ///< edge points on the contour
  std::int32_t arcs = 0;       /// arcs that contain them
  bool bright_inside = false;  ///< brighter inside the contour than outside
};

}  // namespace pharos::ellipse
