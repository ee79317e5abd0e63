// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/depth_plane.hpp"
#include "pharos/tof/tof_settings.hpp"

namespace pharos::tof {

/// The satellite's face: the plane with the most depths on it, less four times those behind it: a boom before the
/// satellite has all of that behind it, the box' sides have the face behind. `front`: only depths behind that plane are
/// used, for a boom that fills most of the frame. Nothing where no plane has 20 samples of a grid of 1,200.
std::optional<DepthPlane> face_plane(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                     const DepthNoise& noise, const DepthPlane* front = nullptr);

/// Amplitude times height over the face, up to kMaxStanding_m: an image in which ring, nozzle and connectors are bright
/// before a dark face, however bright its foil is. For frames whose intensity image does not show the ring.
void make_relief_image(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& face,
                       ImageView<std::uint16_t> image);

/// Rings stand 0.05 to 0.2 m over the face that carries them.
inline constexpr double kMaxStanding_m = 0.25;

}  // namespace pharos::tof
