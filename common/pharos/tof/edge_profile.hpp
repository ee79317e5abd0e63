// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace pharos::tof {

/// Across a box: its top from -half to +half, blurred, and the wall in sight beyond one of the two edges. The blur is
/// that of a triangle, whose step is made of parabolas.
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
    const Step high = step(half_m - place_m), low = step(half_m + place_m);
    Value result{high.value + low.value - 1.0, low.slope - high.slope, low.slope + high.slope, 0.0,
                 -(half_m - place_m) * high.slope - (half_m + place_m) * low.slope};
    const double width = std::fabs(foot_m);
    if (width < 0.2 * blur_m) return result;
    // From here on in the direction of the wall.
    const double sign = foot_m > 0.0 ? 1.0 : -1.0;
    const double beyond = sign * place_m - half_m;
    const double ramp = 1.0 - beyond / width;
    if (ramp <= 0.0) return result;
    const Step edge = step(beyond);
    const double lit = std::min(1.0, ramp) * edge.value;
    const double slope = std::min(1.0, ramp) * edge.slope - (ramp < 1.0 ? edge.value / width : 0.0);
    result.value += wall * lit;
    result.by_place += wall * sign * slope;
    result.by_half -= wall * slope;
    result.by_wall = lit;
    result.by_blur -= wall * std::min(1.0, ramp) * beyond * edge.slope;
    return result;
  }

 private:
  struct Step {
    double value = 0.0;
    double slope = 0.0;
  };
  // From 0 far below to 1 far above, about 0.
  Step step(double x) const {
    const double reach = kTriangle * blur_m;
    if (x <= -reach) return {0.0, 0.0};
    if (x >= reach) return {1.0, 0.0};
    const double rest = reach - std::fabs(x);
    const double tail = 0.5 * rest * rest / (reach * reach);
    return {x > 0.0 ? 1.0 - tail : tail, rest / (reach * reach)};
  }
  static constexpr double kTriangle = 2.4494897427831781;  // sqrt(6): half width over standard deviation
};

}  // namespace pharos::tof
