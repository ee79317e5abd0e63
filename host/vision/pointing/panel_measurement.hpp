// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/pointing/measure_panel.hpp"
#include "host/vision/pointing/panel_sides.hpp"
#include "pharos/base/units.hpp"

namespace pharos::pointing {

/// Direction of a place in the ideal image, frame C, z = 1.
Vector3 ray_of(const Vector2& place_px, const PinholeCamera& camera);

/// One panel's edges, or a wing's two: its edges in one line are one plane where the joint fit is no worse than chance.
PanelMeasurement measurement_of(const std::vector<PanelSides>& panels, const PinholeCamera& camera);

/// From here on an axis is so uncertain that a wrong one lies within five of its sigmas, and perspective tells nothing.
inline constexpr double kUnsureSigma_rad = 18.0 * kRadPerDeg;

/// How much longer the long sides are than the short ones in space, for the axes within two sigmas of the measured one.
struct AspectRange {
  double minimum = 0.0, maximum = 0.0;
};
/// From perspective; nothing where it does not tell. One end is enough: it is square to the axis.
std::optional<AspectRange> aspect_in_space(const PanelMeasurement& panel, const PinholeCamera& camera);

}  // namespace pharos::pointing
