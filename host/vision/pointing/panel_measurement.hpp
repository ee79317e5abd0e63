// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/pointing/measure_panel.hpp"
#include "host/vision/pointing/panel_sides.hpp"

namespace pharos::pointing {

/// One panel's edges, or a wing's two: its edges in one line are one plane where the joint fit is no worse than chance.
PanelMeasurement measurement_of(const std::vector<PanelSides>& panels, const PinholeCamera& camera);

/// How much longer the long sides are than the short ones in space, from perspective; nothing where it does not tell.
/// One end is enough: it is square to the axis.
std::optional<double> aspect_in_space(const PanelMeasurement& panel, const PinholeCamera& camera);

}  // namespace pharos::pointing
