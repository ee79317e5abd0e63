// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/preview/drawing.hpp"
#include "host/vision/slam/slam_system.hpp"

namespace pharos::host {

/// Features of the last pair in the rectified left image: of the map (green), with depth (yellow), others (red).
Drawing slam_drawing(const slam::SlamSystem& system);

}  // namespace pharos::host
