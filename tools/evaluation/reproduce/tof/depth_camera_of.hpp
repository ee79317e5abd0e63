// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "pharos/tof/tof_pose.hpp"
#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::tools {

/// The core's camera for a simulated one.
inline DepthCamera depth_camera_of(const sim::TofScenario& scenario) {
  DepthCamera camera;
  camera.intrinsics = sim::optics_as<PinholeCamera>(scenario.lens);
  camera.depth_scale_m = scenario.depth.scale_m;
  camera.depth_origin_z_m = scenario.depth.origin_z_m;
  return camera;
}

inline tof::TofFrame frame_of(const sim::TofPixels& pixels) {
  return {{pixels.intensity.data(), pixels.width_px, pixels.height_px, pixels.width_px},
          {pixels.depth.data(), pixels.width_px, pixels.height_px, pixels.width_px}};
}

}  // namespace pharos::tools
