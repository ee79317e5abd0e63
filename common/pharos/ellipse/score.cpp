// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  // Both shares end at 1: double edges must not make up for missing ones.
  score.fullness =
      0.5 * std::min(1.0, n / perimeter_px(ellipse)) + 0.5 * std::min(1.0, support.turn_rad / (2.0 * std::numbers::pi));
  return score;
}

}  // namespace pharos::ellipse
