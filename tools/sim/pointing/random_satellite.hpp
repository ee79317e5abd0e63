// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/images/grey_image.hpp"
#include "tools/sim/optics/lens.hpp"
#include "tools/sim/render/solid_scene.hpp"

namespace pharos::sim {

/// A satellite of its own before a telescope of its own, seen from near: body, foil, wings on one or both sides with
/// cells, light, exposure, stars and clutter are drawn at random. Frame C: x right, y down, z ahead.
struct RandomSatellite {
  Lens lens;
  SolidScene scene;
  Vector3 axis_camera = Vector3::UnitX();  ///< of the wings
  double blur_px = 1.0;
  double electrons_per_light = 8000.0;
  int stars = 30;
  int panels = 2;
  // What the rule of availability looks at.
  double from_sight_rad = 0.0;     ///< between axis and line of sight
  double panel_tilt_rad = 0.0;     ///< between the panels' normal and the line of sight
  double sun_incidence_rad = 0.0;  ///< on the side that is seen
  double panel_px = 0.0;           ///< of a panel's length in the image, the longer one
  bool in_image = false;           ///< every panel as a whole
};
RandomSatellite random_satellite(std::uint64_t seed);

/// The telescope's image of it.
host::GreyImage image_of(const RandomSatellite& satellite, std::uint64_t seed);

}  // namespace pharos::sim
