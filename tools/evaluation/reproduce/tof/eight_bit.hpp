// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/tof_pose.hpp"
#include "tools/sim/tof/sensor.hpp"

namespace pharos::tools {

/// The frame with its depth as paper 000 kept it (paper000::eight_bit_depth).
sim::TofPixels eight_bit_frame(const sim::TofPixels& pixels, const DepthCamera& camera);

/// A pose as paper 000, 2.2.1 and 2.3 describe it: the mean of the ring's two ellipses, its centre taken for the
/// circle's centre, a plane through the depths of kRingPoints pixels on it, the connector's middle by its region.
///
/// How many points on the ring the paper takes it does not say; eight reproduce its figures. Nothing where a point has
/// no depth or the frame no connector. `seen` and `workspace` are the measurement of `pixels`: they tell which of the
/// detected ellipses are the ring's edges, and the connector.
std::optional<tof::CameraFromTarget> paper_pose(const sim::TofPixels& pixels, const DepthCamera& camera,
                                                const tof::TofPose& seen, const tof::TofWorkspace& workspace);
inline constexpr int kRingPoints = 8;

}  // namespace pharos::tools
