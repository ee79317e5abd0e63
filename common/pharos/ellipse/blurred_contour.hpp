// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "pharos/ellipse/arc.hpp"
#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ellipse/matrix.hpp"
#include "pharos/ellipse/refine_fit.hpp"

namespace pharos::ellipse {

/// Cosine and sine of an ellipse's direction and of twice it.
struct Turned {
  double cos = 1.0, sin = 0.0, cos2 = 1.0, sin2 = 0.0;
  explicit Turned(double theta_rad) : cos(std::cos(theta_rad)), sin(std::sin(theta_rad)) {
    cos2 = cos * cos - sin * sin;
    sin2 = 2.0 * sin * cos;
  }
};

/// Signed distances of points from the blurred contour's edge, and the terms of their derivatives. Columns, so that
/// compilers take roots and divisions two at a time.
struct ContourDistances {
  using Column = std::array<double, kMaxFitPoints>;
  Column x, y;        ///< in the ellipse's axes
  Column fx, fy;      ///< slope of f = (x/a)^2 + (y/b)^2 - 1
  Column per_length;  ///< 1 / |slope|
  Column value;       ///< px, positive outside
};

/// Where an ellipse's edge is steepest after blur: inside a curved edge, and outside on the flanks of a narrow ellipse.
class BlurredContour {
 public:
  /// `ellipse` must outlive it.
  explicit BlurredContour(const Ellipse& ellipse);

  /// At most kMaxFitPoints points.
  void measure(std::span<const PointF> points, ContourDistances& distances) const;
  /// Derivative of point k's distance by (cx, cy, m, e1, e2), m = (a+b)/2, (e1, e2) = (a-b)/2 (cos, sin)(2 theta).
  Vector5 slope(const ContourDistances& distances, std::size_t k) const;
  /// Derivative of (cx, cy, a, b, theta) by those parameters.
  Matrix5 axes_slope() const;
  const Turned& turned() const { return turned_; }

 private:
  const Ellipse& ellipse_;
  Turned turned_;
  double ka_, kb_;  // 1 / a^2, 1 / b^2
  double push_at_a_px_ = 0.0, push_at_b_px_ = 0.0;
};

/// The ellipse moved by (cx, cy, m, e1, e2) of BlurredContour::slope; empty where nothing is left of its minor axis.
std::optional<Ellipse> moved_by(const Ellipse& ellipse, const Turned& turned, const Vector5& step);

/// Near a circle the direction is undefined: its variance is at most that of a uniform one, and uncorrelated then.
void limit_direction(Matrix5& covariance);

}  // namespace pharos::ellipse
