// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/images/grey_image.hpp"
#include "tools/sim/render/solid_scene.hpp"
#include "tools/sim/ring2/stereo_rig.hpp"

namespace pharos::sim {

/// A target of its own before a rig of its own: body, foil, ring, nozzle, light, lenses, exposure and clutter are drawn
/// at random. The scene is in the rig's frame.
struct RandomTarget {
  StereoRig rig;
  RingAndNozzle truth;
  SolidScene scene;
  double blur_px = 0.7;
  double electrons_per_light = 8000.0;
  /// A second ring with a nozzle of its own: nobody can tell which is meant.
  bool has_twin = false;
  /// What the rule of availability looks at.
  double sun_incidence_rad = 0.0;  ///< on the ring's face
  double nozzle_minor_px = 0.0;    ///< the smaller semi-axis of its image in either view
  bool in_both_images = false;     ///< ring and nozzle as a whole
  bool is_crossed = false;         ///< a boom lies across the ring
};
RandomTarget random_target(std::uint64_t seed);

/// One camera's image of it.
host::GreyImage image_of(const RandomTarget& target, std::size_t view, std::uint64_t seed);

}  // namespace pharos::sim
