// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::ring2 {

enum class View : std::uint8_t { kLeft, kRight };
inline constexpr std::size_t kViews = 2;

/// One camera of the rig: its optics and its pose in the rig's frame (x right, y down, z ahead).
struct RigView {
  PinholeCamera intrinsics;
  Pose<frame::Rig, frame::Camera> T_rig_camera;
};

/// Two cameras fixed to each other; views[0] is the left one.
struct Rig {
  std::array<RigView, kViews> views;
};

enum class RigFault : std::uint8_t {
  kNone,
  kIntrinsics,       // an invalid focal length or size, or a value that is not finite
  kRotation,         // R^T R is not the unit matrix, or R mirrors
  kCamerasCoincide,  // their centres are less than a millimetre apart
};
RigFault fault_of(const Rig& rig);

}  // namespace pharos::ring2
