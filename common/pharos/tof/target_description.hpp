// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/static_vector.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::tof {

/// Connectors of a description.
inline constexpr std::size_t kMaxDescribed = 8;

/// A connector as a drawing or a recording states it, in the target frame T: origin at the ring's centre, Z' its
/// normal.
struct DescribedConnector {
  Vector2 place_m = Vector2::Zero();
  double height_m = 0.0;  ///< of its face over the ring's plane, or over the plate: either is accepted
  Vector2 size_m = Vector2::Zero();
  double sigma_place_m = 0.001;
  double sigma_height_m = 0.001;
};

/// What is known of the target's connectors. X' is then the description's, and not the direction to the nearest one.
struct TargetDescription {
  StaticVector<DescribedConnector, kMaxDescribed> connectors;

  bool stated() const { return !connectors.empty(); }
};

}  // namespace pharos::tof
