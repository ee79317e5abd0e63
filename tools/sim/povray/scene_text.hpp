// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/sim/optics/lens.hpp"

namespace pharos::sim {

/// A vector of a right-handed frame (x right, y down, z ahead) in POV-Ray's left-handed one (x right, y up, z ahead):
/// "<x, -y, z>", metres or no unit. Every point, normal and axis of a scene goes through here.
std::string povray_vector(const Vector3& vector);

/// The `camera { ... }` of a scene: where it stands and how it is turned in the scene's frame (p_world = R p_camera +
/// t). Lens distortion is left out: POV-Ray has none. The principal point may lie anywhere.
std::string povray_camera(const Lens& lens, const Matrix3& R_world_camera, const Vector3& t_world_camera_m);

/// The beginning of a scene: the language's version, linear light, and no light other than the scene's own.
std::string povray_preamble();

}  // namespace pharos::sim
