// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/camera/depth_camera.hpp"
#include "pharos/geometry/pose.hpp"
#include "tools/sim/tof/sensor.hpp"

namespace pharos::tools {

/// How the scene moved in the camera's frame from one frame to the other, p_second = R p_first + t, by ORB features
/// matched between the two (the first one's depth gives them their place) and RANSAC over their reprojections. Nothing
/// where too few features agree.
std::optional<Pose<frame::Camera, frame::Camera>> orb_motion(const sim::TofPixels& first, const sim::TofPixels& second,
                                                             const DepthCamera& camera);

}  // namespace pharos::tools
