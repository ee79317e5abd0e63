// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/preview/drawing.hpp"
#include "host/vision/ring2/ring2_detector.hpp"

namespace pharos::host {

/// What was found in one view (0 left, 1 right): all ellipses (grey, dashed), those taken for ring and nozzle (light
/// blue), both circles as measured (ring green, nozzle yellow) and their axis (orange).
Drawing ring2_drawing(const Ring2Detection& circles, const ring2::Rig& rig, std::size_t view);

}  // namespace pharos::host
