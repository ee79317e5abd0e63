// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/mounting/noise_time.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::calibrate {
namespace {

constexpr double kLagKnots = 1.0 / 12.0;  // the spline takes up 4 % of a difference over it, 10 % of one over twice it
constexpr double kLongestKnots = 2.0;
constexpr double kMinAlike = 0.2;  // of the variance: what scatter and a wrong statement can look like
constexpr std::size_t kMinPairs = 200;

// Mean squared difference of residuals `lag_s` apart, within a quarter, over what both state: one for independent
// noise.
struct Difference {
  double rotation = 0.0, position = 0.0, lag_s = 0.0;
  std::size_t pairs = 0;
};

Difference difference_over(const std::vector<MountingResidual>& residuals, double lag_s) {
  Difference out;
  std::size_t earlier = 0;
  for (const MountingResidual& later : residuals) {
    while (later.time_s - residuals[earlier].time_s > 1.25 * lag_s) ++earlier;
    const MountingResidual& before = residuals[earlier];
    if (later.time_s - before.time_s < 0.75 * lag_s || !later.used || !before.used) continue;
    out.rotation += (later.rotation_rad - before.rotation_rad).squaredNorm() /
                    (later.rotation_variance_rad2 + before.rotation_variance_rad2);
    out.position += (later.position_m - before.position_m).squaredNorm() /
                    (later.position_variance_m2 + before.position_variance_m2);
    out.lag_s += later.time_s - before.time_s;
    ++out.pairs;
  }
  if (out.pairs == 0) return out;
  const auto pairs = static_cast<double>(out.pairs);
  out.rotation /= pairs;
  out.position /= pairs;
  out.lag_s /= pairs;
  return out;
}

// v T from what is alike at two lags, v exp(-lag / T). Infinite: for good.
double time_of(double difference, double lag_s, double difference_of_two, double lag_of_two_s) {
  const double alike = 1.0 - difference;
  if (alike < kMinAlike) return 0.0;
  const double ratio = (1.0 - difference_of_two) / alike;
  if (!(ratio > 0.0)) return 0.0;
  if (!(ratio < 1.0)) return HUGE_VAL;
  const double time_s = (lag_of_two_s - lag_s) / -std::log(ratio);
  return std::min(1.0, alike * std::exp(lag_s / time_s)) * time_s;
}

}  // namespace

double noise_time_s(const MountingFit& fit, double knot_s) {
  const Difference one = difference_over(fit.residuals, kLagKnots * knot_s);
  const Difference two = difference_over(fit.residuals, 2.0 * kLagKnots * knot_s);
  if (one.pairs < kMinPairs || two.pairs < kMinPairs) return 0.0;
  const double time_s = std::min(time_of(one.rotation, one.lag_s, two.rotation, two.lag_s),
                                 time_of(one.position, one.lag_s, two.position, two.lag_s));
  return time_s < kLongestKnots * knot_s ? time_s : 0.0;
}

}  // namespace pharos::calibrate
