// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/noise_level.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kNoiseHuber = 3.0;  // larger residuals count as this: they are outliers and must not raise the level
constexpr double kOutlier = 6.0;
constexpr double kMedianToSigma = 1.4826;
constexpr double kMax_rad = 600.0 * kRadPerArcsec;

double free_fraction(const BearingResidual& r) { return std::max(1.0 - r.leverage, 0.02); }

// Residual in its own sigmas, corrected for its leverage.
double normalised(const BearingResidual& r) { return r.residual_rad / (r.sigma_rad * std::sqrt(free_fraction(r))); }

double usual(const std::vector<BearingResidual>& residuals) {
  std::vector<double> sizes;
  for (const BearingResidual& r : residuals) sizes.push_back(std::abs(normalised(r)));
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kMedianToSigma * *middle, 1.0);
}

}  // namespace

double unmodelled_level(const std::vector<BearingResidual>& residuals, double present_rad) {
  double freedom = 0.0;
  for (const BearingResidual& r : residuals) freedom += std::max(1.0 - r.leverage, 0.0);
  const double limit = kNoiseHuber * usual(residuals);
  const auto excess = [&](double level_rad) {
    double sum = 0.0;
    for (const BearingResidual& r : residuals) {
      if (std::abs(normalised(r)) > limit) continue;
      const double variance = r.sigma_rad * r.sigma_rad - present_rad * present_rad + level_rad * level_rad;
      sum += r.residual_rad * r.residual_rad / variance;
    }
    return sum - freedom;
  };
  if (freedom <= 0.0 || excess(0.0) < 3.0 * std::sqrt(2.0 * freedom)) return 0.0;
  double low = 0.0;
  double high = kMax_rad;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return high;
}

std::size_t reject_outliers(const std::vector<BearingResidual>& residuals, std::vector<StationaryAverage>& intervals) {
  const double limit = kOutlier * usual(residuals);
  std::size_t rejected = 0;
  // From the end, so that the remaining indices stay valid.
  for (auto r = residuals.rbegin(); r != residuals.rend(); ++r) {
    if (std::abs(normalised(*r)) < limit) continue;
    auto& bearings = intervals[r->interval].rotors[r->view].bearings;
    bearings.erase(bearings.begin() + static_cast<std::ptrdiff_t>(r->bearing));
    ++rejected;
  }
  return rejected;
}

}  // namespace pharos::calibrate
