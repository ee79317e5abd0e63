// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/geometry/types.hpp"
#include "pharos/tof/depth_plane.hpp"

namespace pharos::tof {

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

enum class RingEdge : std::uint8_t { kOuter = 0, kInner = 1 };
inline constexpr std::array<RingEdge, 2> kRingEdges = {RingEdge::kOuter, RingEdge::kInner};
inline constexpr std::size_t index_of(RingEdge edge) { return static_cast<std::size_t>(edge); }

/// Two concentric circles in one plane, frame C, metres.
struct RingModel {
  Vector3 centre_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitZ();  ///< unit, towards the camera
  std::array<double, 2> radius_m{};    ///< by RingEdge

  double radius(RingEdge edge) const { return radius_m[index_of(edge)]; }
  /// Its plane as q . P = 1.
  DepthPlane plane() const { return {normal / normal.dot(centre_m)}; }
};

/// Two unit vectors across a unit normal that points towards the camera: the first as near to the camera's x axis as
/// can be, the second normal x first.
struct PlaneAxes {
  Vector3 first;
  Vector3 second;
};
inline PlaneAxes axes_of(const Vector3& normal) {
  const Vector3 first = (Vector3::UnitX() - normal.x() * normal).normalized();
  return {first, normal.cross(first)};
}

}  // namespace pharos::tof
