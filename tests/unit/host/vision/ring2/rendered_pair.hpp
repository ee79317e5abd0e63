// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "host/images/grey_image.hpp"
#include "host/vision/ring2/ring2_detector.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"
#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/povray/render_scene.hpp"
#include "tools/sim/ring2/ring2_scenario.hpp"

namespace pharos::host {

/// Sampling of edges in the renderer.
struct Rays {
  int per_side = 4;
  double threshold = 0.01;
};

/// Both cameras' images of one pose of a scenario.
inline std::array<GreyImage, 2> rendered_pair(const sim::Ring2Scenario& scenario, std::size_t pair, Rays rays = {}) {
  std::array<GreyImage, 2> images;
  for (std::size_t v = 0; v < 2; ++v) {
    const sim::LinearImage light =
        sim::render_scene(sim::ring2_scene_text(scenario, pair, v), {.width_px = scenario.rig[v].width_px,
                                                                     .height_px = scenario.rig[v].height_px,
                                                                     .rays_per_side = rays.per_side,
                                                                     .antialias_threshold = rays.threshold});
    sim::RandomStream random(7, "pixels " + std::to_string(2 * pair + v));
    images[v] = sim::expose(sim::blurred(light, scenario.blur_px), {}, random);
  }
  return images;
}

inline Ring2Images views_of(const std::array<GreyImage, 2>& images) { return {images[0].view(), images[1].view()}; }

inline double angle_deg(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 57.29577951308232;
}

}  // namespace pharos::host
