// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// The satellite of paper 004, section 3: a box of 1.4 x 1.4 x 1.6 m in wrinkled foil, two solar panels of 1.1 x 1.0 m
/// on its sides. Its frame: origin in the box's middle, z the spin axis, panels along x. 3.8 m across.
PanelScene satellite_scene(std::uint64_t seed);

/// What a camera behind a red, green or blue filter (channel 0 to 2) sees of satellite_scene: golden foil, blue cells.
PanelScene through_filter(PanelScene satellite, int channel);

/// `count` stars ahead of the cameras, brighter ones rarer.
std::vector<Star> star_field(int count, std::uint64_t seed);

/// Least half size of a box in which the satellite turns, m.
inline constexpr double kSatelliteReach_m = 1.9;

}  // namespace pharos::sim
