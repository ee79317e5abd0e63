// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// Two ellipses, one of each image, that are images of one circle in space.
struct MatchedCircle {
  std::array<std::size_t, ring2::kViews> index{};  ///< of the ellipse in each view
  Vector3 centre_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitZ();
  double radius_m = 0.0;
};

/// All such pairs: rays through the ellipses' centres intersect, sizes agree, and the residual of the joint fit is
/// within the noise.
std::vector<MatchedCircle> matched_circles(const ring2::Rig& rig,
                                           const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours);

/// Which matched circle is the ring and which the nozzle; each may be missing.
struct RingAndNozzleChoice {
  const MatchedCircle* ring = nullptr;
  const MatchedCircle* nozzle = nullptr;
};
RingAndNozzleChoice choose_circles(std::span<const MatchedCircle> circles);

}  // namespace pharos::host
