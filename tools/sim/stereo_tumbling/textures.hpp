// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/random_stream.hpp"
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// Wrinkled foil: flat facets of many brightnesses (cells of a Voronoi pattern, about `facet_m` wide), darker creases.
Texture foil_texture(double width_m, double height_m, double facet_m, RandomStream& random);

/// A solar panel: rows of dark cells between bright conductors; every cell has its own shade and contact marks.
Texture solar_texture(double width_m, double height_m, double cell_m, RandomStream& random);

/// A wall: broad stains, and pictures hung on it.
Texture wall_texture(double width_m, double height_m, RandomStream& random);

}  // namespace pharos::sim
