// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "pharos/ellipse/ellipse.hpp"

namespace pharos::ellipse {

/// Places along a contour at equal steps of the eccentric anomaly, from 0 on; without trigonometry for each.
class ContourPlaces {
 public:
  struct Place {
    PointPx point;
    double normal_u = 0.0, normal_v = 0.0;  ///< outwards, of length 1
    double per_speed = 0.0;                 ///< anomaly over length of the contour there, 1/px
  };

  /// `count` steps make the whole contour.
  ContourPlaces(const Ellipse& e, int count)
      : e_(e),
        cos_(std::cos(e.theta_rad)),
        sin_(std::sin(e.theta_rad)),
        step_cos_(std::cos(2.0 * std::numbers::pi / count)),
        step_sin_(std::sin(2.0 * std::numbers::pi / count)) {}

  Place next() {
    const double along = e_.a_px * x_, across = e_.b_px * y_, nx = e_.b_px * x_, ny = e_.a_px * y_;
    const double per_length = 1.0 / std::sqrt(nx * nx + ny * ny);
    const Place place{{e_.cx_px + cos_ * along - sin_ * across, e_.cy_px + sin_ * along + cos_ * across},
                      per_length * (cos_ * nx - sin_ * ny),
                      per_length * (sin_ * nx + cos_ * ny),
                      per_length};
    const double x = step_cos_ * x_ - step_sin_ * y_;
    y_ = step_sin_ * x_ + step_cos_ * y_;
    x_ = x;
    return place;
  }

 private:
  Ellipse e_;
  double cos_, sin_, step_cos_, step_sin_;
  double x_ = 1.0, y_ = 0.0;
};

}  // namespace pharos::ellipse
