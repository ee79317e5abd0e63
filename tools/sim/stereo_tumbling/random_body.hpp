// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/sim/render/solid_scene.hpp"

namespace pharos::sim {

/// A satellite drawn at random: bus, wings, dish, mast, covers, thrusters; foil, paint, albedos; its light and its
/// spin.
struct RandomBody {
  /// In the body's own frame, origin in the bus' middle. `to_sun` and `fill` of it are not used.
  SolidScene scene;
  /// Every part outside the bus has its like on the opposite side (half a turn about z), wings to the last cell.
  bool symmetric = false;
  double reach_m = 1.0;                       ///< of its parts from the origin
  Vector3 spin_axis_body = Vector3::UnitZ();  ///< unit
  Matrix3 R_rig_body = Matrix3::Identity();   ///< at the first pair
  Vector3 to_sun_rig = -Vector3::UnitZ();     ///< unit; the sun is at rest before the cameras
  double fill = 0.05;                         ///< 0.02 (hard light) to 0.4 (soft)
};

/// Every second seed's body is symmetric.
RandomBody random_body(std::uint64_t seed);

}  // namespace pharos::sim
