// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/image_profile.hpp"

#include <algorithm>

namespace pharos::tof {
namespace {

// Derivative of a Gaussian of 1 px at -kProfileReach_px .. kProfileReach_px.
constexpr std::array<double, 7> kSlope = {-0.0133, -0.108, -0.242, 0.0, 0.242, 0.108, 0.0133};

}  // namespace

ProfileEdge steepest_of_samples(const std::array<double, kMaxSamples>& profile, int search_px, double sign) {
  std::array<double, 2 * kMaxSearch_px + 1> slope{};
  int best = 0;
  for (int k = 0; k <= 2 * search_px; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kSlope.size(); ++i) sum += kSlope[i] * profile[static_cast<std::size_t>(k) + i];
    slope[static_cast<std::size_t>(k)] = sign * sum;
    if (slope[static_cast<std::size_t>(k)] > slope[static_cast<std::size_t>(best)]) best = k;
  }
  if (best == 0 || best == 2 * search_px) return {};
  const auto at = static_cast<std::size_t>(best);
  const double left = slope[at - 1];
  const double top = slope[at];
  const double right = slope[at + 1];
  const double bend = left - 2.0 * top + right;
  if (!(bend < 0.0) || !(top > 0.0)) return {};
  return {best - search_px + 0.5 * (left - right) / bend, top};
}

}  // namespace pharos::tof
