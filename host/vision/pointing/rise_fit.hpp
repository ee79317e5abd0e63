// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace pharos::pointing {

/// The pixels of one row or column across the edge.
struct Profile {
  std::array<double, 64> position{};  ///< px across the edge, increasing into the target
  std::array<double, 64> value{};
  std::size_t size = 0;
};

/// A Gaussian's integral from the sky to the target.
struct Rise {
  double place = 0.0;  ///< px across
  double dark = 0.0, bright = 0.0;
  double residual = 0.0;  ///< sum of squares
};

/// Fraction of its height that a rise has `sigmas` of blur beyond its middle; accurate to 5e-7.
double rise_fraction(double sigmas);

/// Least squares over position, dark and bright level, for a given blur, px: Gauss-Newton on the position from `start`
/// px, the levels are eliminated. Empty where the profile does not determine them.
std::optional<Rise> fit_rise(const Profile& profile, double blur, double start);

}  // namespace pharos::pointing
