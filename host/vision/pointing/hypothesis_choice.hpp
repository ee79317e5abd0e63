// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/pointing/measure_panel.hpp"
#include "host/vision/pointing/panel_choice.hpp"

namespace pharos::pointing {

/// The panel among an outline's facing pairs: each is measured, pairs on one axis are a wing, and what its geometry in
/// space contradicts is left out. What perspective makes sharp must be confirmed by something that a pair of any two
/// edges would not have: a second panel on the axis, ends square to it, a third edge along it. Where two that are so
/// confirmed have different axes, the second one is the measurement's alternative.
Result<PanelMeasurement, PointingRefusal> choose_panel(ImageView<const std::uint16_t> image, const TargetMask& target,
                                                       const PinholeCamera& camera, const std::vector<Segment>& outline,
                                                       const std::vector<EdgePair>& pairs);

}  // namespace pharos::pointing
