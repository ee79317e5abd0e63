// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/score.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::ellipse {
namespace {

constexpr double kPerDistance = 0.3;  // (3)

}  // namespace

double Score::value() const { return shape * std::sqrt(accuracy * fullness); }

Score score_of(const Ellipse& ellipse, const Support& support, const EllipseSettings& settings) {
  Score score;
  if (support.count == 0) return score;
  const double n = support.count;
  score.shape = ellipse.a_px < settings.max_axis_ratio * ellipse.b_px ? 1.0 : 0.0;
  score.accuracy = std::max(0.0, 1.0 - kPerDistance * support.distance_sum_px / n);
  // Where edges are double, N would compensate for missing ones: it is limited to the sectors that have points.
  // What lies outside the image cannot be seen, and is not missed.
  const double length_fraction = std::min(n / perimeter_px(ellipse), support.length_fraction);
  score.fullness = std::min(
      1.0, 0.5 * length_fraction / support.inside_fraction + 0.5 * support.turn_fraction / support.inside_turn);
  return score;
}

}  // namespace pharos::ellipse
