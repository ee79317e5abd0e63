// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/ring2/solve.hpp"
#include "tools/sim/ring2/projected_ellipse.hpp"

namespace pharos::ring2 {

/// A simulated scene of paper 001: where ring and nozzle are and who looks.
struct Scene {
  sim::StereoRig rig;
  sim::RingAndNozzle target;
};

/// The simulator's rig as the estimator takes it.
inline Rig core_rig(const sim::StereoRig& from) {
  Rig rig;
  for (std::size_t v = 0; v < kViews; ++v) {
    const sim::StereoCamera& camera = from[v];
    rig.views[v].intrinsics = sim::optics_as<PinholeCamera>(camera);
    rig.views[v].T_rig_camera = {camera.R_rig_camera, camera.t_rig_camera_m};
  }
  return rig;
}

inline ellipse::Ellipse core_ellipse(const sim::ImageEllipse& e) {
  return {e.cx_px, e.cy_px, e.a_px, e.b_px, e.theta_rad};
}

/// The four ellipses without noise; what is said of their noise is 0.1 px and a point a pixel.
inline ContourSet clean_contours(const Scene& scene) {
  ContourSet contours;
  for (std::size_t v = 0; v < kViews; ++v) {
    for (std::size_t f = 0; f < kFeatures; ++f) {
      const auto e = sim::projected_ellipse(scene.rig[v], f == 0 ? scene.target.ring() : scene.target.nozzle());
      if (e) contours[v][f] = contour_of(core_ellipse(*e), 0.1, ellipse::perimeter_px(core_ellipse(*e)));
    }
  }
  return contours;
}

/// The four ellipses as fitted to noisy edge points, one a pixel.
inline ContourSet noisy_contours(const Scene& scene, double sigma_px, std::uint64_t seed) {
  ContourSet contours;
  sim::RandomStream random(seed, "edge points");
  for (std::size_t v = 0; v < kViews; ++v) {
    for (std::size_t f = 0; f < kFeatures; ++f) {
      int points = 0;
      const auto e = sim::noisy_ellipse(scene.rig[v], f == 0 ? scene.target.ring() : scene.target.nozzle(), sigma_px,
                                        random, points);
      if (e) contours[v][f] = contour_of(core_ellipse(*e), sigma_px, points);
    }
  }
  return contours;
}

}  // namespace pharos::ring2
