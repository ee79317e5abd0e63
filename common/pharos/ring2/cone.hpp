// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ring2/rig.hpp"

namespace pharos::ring2 {

/// A circle seen from the apex of a cone, in the axes of the rig: its plane's unit normal towards the apex, and its
/// centre from there per unit of radius.
struct CirclePose {
  Vector3 normal = Vector3::UnitZ();
  Vector3 centre_per_radius = Vector3::Zero();
};

/// Direction and size of a circle's image: radius = radius_per_range * range along the unit direction.
struct ApparentCircle {
  Vector3 direction = Vector3::UnitZ();
  double radius_per_range = 0.0;
};

/// The cone over an ellipse: X^T Q X = 0 of rays X from the camera in the rig's axes, negative inside.
struct Cone {
  Matrix3 Q = Matrix3::Identity();
  Vector3 forward = Vector3::UnitZ();  /// the camera's own axis: selects the half of the cone before it
};

/// The contour's points are undistorted one by one and a conic is fitted to the rays; without distortion it is exact.
/// Empty where the lens has no such pixels or the curve is not an ellipse among the rays.
std::optional<Cone> cone_of(const ellipse::Ellipse& ellipse, const RigView& view);

/// The two circles of one cone (Chen and Huang 1999, reference 12 of paper 001; here by the cone's principal axes).
/// Equal where the circle is seen face on.
std::optional<std::array<CirclePose, 2>> circle_poses(const Cone& cone);

/// Direction and relative size of the circle that the cone would have in a plane of that normal. Exact for the normals
/// of circle_poses, smooth around them. Empty for planes that the cone does not intersect in such a circle, or whose
/// back is seen.
std::optional<ApparentCircle> apparent_circle(const Cone& cone, const Vector3& normal);

}  // namespace pharos::ring2
