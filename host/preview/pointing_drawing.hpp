// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/preview/drawing.hpp"
#include "host/vision/pointing/measure_panel.hpp"

namespace pharos::host {

/// The outline's edges (grey), the panel's short sides (light blue) and its long ones (green), as the lens bends them.
Drawing pointing_drawing(const pointing::PanelMeasurement& panel, const PinholeCamera& camera);

}  // namespace pharos::host
