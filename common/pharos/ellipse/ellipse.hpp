// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::ellipse {

/// An ellipse in the image. Pixel (0, 0) is the centre of the first pixel; u to the right, v downwards.
struct Ellipse {
  double cx_px = 0.0;
  double cy_px = 0.0;
  double a_px = 0.0;  ///< semi-axes, a >= b
  double b_px = 0.0;
  double theta_rad = 0.0;  ///< direction of a, from +u towards +v, in (-pi/2, pi/2]
};

struct PointPx {
  double u = 0.0;
  double v = 0.0;
};

/// Length of the contour; Ramanujan's formula, as in the denominator of (4) of paper 000.
double perimeter_px(const Ellipse& ellipse);

/// Point of the contour at eccentric anomaly `t_rad`: centre + R(theta) (a cos t, b sin t).
PointPx point_at(const Ellipse& ellipse, double t_rad);

/// Eccentric anomaly, in (-pi, pi], of the contour's point nearest to `point`: the inverse of point_at.
double anomaly_of(const Ellipse& ellipse, PointPx point);

/// Signed distance to the contour, positive outside, to first order (Sampson): good where the point is much nearer to
/// the contour than the contour's radius of curvature b^2/a. Elsewhere it has the right sign and grows outwards.
double distance_px(const Ellipse& ellipse, PointPx point);
/// The same for many points: the axes' directions are calculated once.
class EllipseDistance {
 public:
  explicit EllipseDistance(const Ellipse& ellipse);
  double px(PointPx point) const;
  /// Its square, without a root.
  double squared_px2(PointPx point) const;
  /// To the nearest point of the contour, within a thousandth of the axes at any distance; slower.
  double far_px(PointPx point) const;

 private:
  Ellipse ellipse_;
  double cos_, sin_;
};

/// The same ellipse with a >= b and theta in (-pi/2, pi/2].
Ellipse normalised(Ellipse ellipse);

}  // namespace pharos::ellipse
