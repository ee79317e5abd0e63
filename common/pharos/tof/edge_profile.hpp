// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace pharos::tof {

/// From 0 far below to 1 far above, blurred by a cubic B-spline of a standard deviation: a bell with the tails of a
/// normal distribution's up to 3.5 deviations, without an exponential.
struct BlurredStep {
  double value = 0.0;
  double slope = 0.0;
};
inline BlurredStep blurred_step(double x, double blur) {
  constexpr double kKnots = 0.57735026918962576;  // the spline's own deviation, 1/sqrt(3) of the distance of its knots
  const double scale = kKnots / blur;
  const double u = std::fabs(x) * scale;
  if (u >= 2.0) return {x > 0.0 ? 1.0 : 0.0, 0.0};
  const double rest = 2.0 - u, square = u * u;
  const double tail =
      u < 1.0 ? 0.5 - u * (2.0 / 3.0 - square * (1.0 / 3.0 - u / 8.0)) : rest * rest * rest * rest / 24.0;
  const double bell = u < 1.0 ? 2.0 / 3.0 - square * (1.0 - 0.5 * u) : rest * rest * rest / 6.0;
  return {x > 0.0 ? 1.0 - tail : tail, bell * scale};
}

/// Across a box: its top from -half to +half, blurred, and the wall in sight beyond one of the two edges.
struct EdgeProfile {
  double half_m = 0.0;
  double blur_m = 0.0;  ///< standard deviation
  /// Where the foot of the wall in sight appears from its upper edge; positive: beyond the edge at +half.
  double foot_m = 0.0;

  struct Value {
    double value = 0.0;
    double by_place = 0.0;
    double by_half = 0.0;
    double by_wall = 0.0;
    double by_blur = 0.0;  ///< times the blur: by its logarithm
  };

  /// At a place across, for a wall of a brightness relative to the top's.
  Value at(double place_m, double wall) const {
    const BlurredStep high = blurred_step(half_m - place_m, blur_m), low = blurred_step(half_m + place_m, blur_m);
    Value result{high.value + low.value - 1.0, low.slope - high.slope, low.slope + high.slope, 0.0,
                 -(half_m - place_m) * high.slope - (half_m + place_m) * low.slope};
    const double width = std::fabs(foot_m);
    if (width < 0.2 * blur_m) return result;
    // From here on in the direction of the wall.
    const double sign = foot_m > 0.0 ? 1.0 : -1.0;
    const double beyond = sign * place_m - half_m;
    const double ramp = 1.0 - beyond / width;
    if (ramp <= 0.0) return result;
    const BlurredStep edge = blurred_step(beyond, blur_m);
    const double lit = std::min(1.0, ramp) * edge.value;
    const double slope = std::min(1.0, ramp) * edge.slope - (ramp < 1.0 ? edge.value / width : 0.0);
    result.value += wall * lit;
    result.by_place += wall * sign * slope;
    result.by_half -= wall * slope;
    result.by_wall = lit;
    result.by_blur -= wall * std::min(1.0, ramp) * beyond * edge.slope;
    return result;
  }
};

}  // namespace pharos::tof
