// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/render/subpixels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pharos::sim {
namespace {

double integral_of_normal(double x) {
  const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
  return x * 0.5 * std::erfc(-x / std::numbers::sqrt2) + density;
}

// Fraction of a pixel's light, its own width blurred, that comes from left of `x` (from its middle).
double fraction_left_of(double x, double blur_px) {
  if (blur_px <= 0.0) return std::clamp(x + 0.5, 0.0, 1.0);
  return blur_px * (integral_of_normal((x + 0.5) / blur_px) - integral_of_normal((x - 0.5) / blur_px));
}

double place_of_fraction(double fraction, double blur_px) {
  double low = -blurred_subpixel_reach(blur_px), high = -low;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (fraction_left_of(middle, blur_px) < fraction ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<Subpixel> blurred_subpixels(int count, double blur_px) {
  constexpr double kPlastic = 1.32471795724474602596;
  std::vector<Subpixel> places;
  for (int i = 1; i <= count / 2; ++i) {
    const auto fraction = [&](double step) { return std::fmod(0.5 + step * i, 1.0); };
    const double s = place_of_fraction(fraction(1.0 / kPlastic), blur_px);
    const double t = place_of_fraction(fraction(1.0 / (kPlastic * kPlastic)), blur_px);
    places.push_back({s, t});
    places.push_back({-s, -t});
  }
  return places;
}

}  // namespace pharos::sim
