// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tools/sim/optics/linear_image.hpp"

namespace pharos::sim {

struct RenderSettings {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  /// An antialiased pixel is the mean of so many rays squared, spread evenly over its area; 1 to 9. 1: one ray through
  /// its centre.
  int rays_per_side = 4;
  /// Least difference of light from the left or upper neighbour that makes a pixel (and that neighbour) worth more than
  /// one ray; 0: every pixel gets all of its rays.
  double antialias_threshold = 0.0;
  /// Threads of POV-Ray.
  int threads = 1;
};

/// Renders a scene of POV-Ray's language by the program `povray`. The same text gives the same image.
///
/// `scene`: the whole of it, with a camera (scene_text.hpp). Light above 1 comes as 1, steps are 1/65535. Works in a
/// directory of its own under $TMPDIR that goes afterwards; reads no settings of the user's. Throws host::InputError
/// where povray is missing or finds a fault in the scene (its own words).
LinearImage render_scene(const std::string& scene, const RenderSettings& settings);

}  // namespace pharos::sim
