// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::host {

/// Points of a circle in space, the first one again at the end; `first` and `second` are unit vectors across its axis.
inline std::vector<Vector3> circle_points(const Vector3& centre_m, const Vector3& first, const Vector3& second,
                                          double radius_m) {
  constexpr int kPieces = 180;
  std::vector<Vector3> points;
  points.reserve(kPieces + 1);
  for (int k = 0; k <= kPieces; ++k) {
    const double angle = kTwoPi * k / kPieces;
    points.push_back(centre_m + radius_m * (std::cos(angle) * first + std::sin(angle) * second));
  }
  return points;
}

}  // namespace pharos::host
