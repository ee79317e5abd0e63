// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "host/preview/drawing.hpp"
#include "pharos/tof/tof_pose.hpp"

namespace pharos::host {

/// Position of a point of the camera's frame in the image; empty behind the camera.
std::optional<Place> place_of(const PinholeCamera& camera, const Vector3& point_camera_m);

/// What a pose was measured from: the ring's circles as fitted (green), the connector that gives the turn (orange), and
/// the target's axes (X' red, Y' green, Z' blue; without a turn Z' alone).
Drawing tof_drawing(const tof::TofPose& pose, const DepthCamera& camera);

/// All ellipses of an image (blue, dashed): what a frame without a pose has.
Drawing ellipses_drawing(const ellipse::EllipseWorkspace& found);

/// A rectangle parallel to the ring's plane, `height_m` over it.
void add_rectangle(Drawing& drawing, const DepthCamera& camera, const tof::RingModel& ring,
                   const tof::PlanarRectangle& rectangle, double height_m, Colour colour, double width);

}  // namespace pharos::host
