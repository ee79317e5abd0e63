// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/ring2/solve.hpp"
#include "tools/sim/stereo/projected_ellipse.hpp"

namespace pharos::ring2 {

inline constexpr double kDeg = 3.14159265358979323846 / 180.0;

/// A scene of paper 001: where ring and nozzle are and who looks.
struct Scene {
  sim::StereoRig rig;
  sim::RingAndNozzle target;
};

/// Ring's centre `range_m` before the rig's middle, facing it but for the two angles; f = 600 px.
inline Scene scene_of(double theta_rad, double gamma_rad, double range_m = 3.0, double baseline_m = 1.8,
                      double toe_in_rad = 20.0 * kDeg) {
  Scene scene;
  scene.rig = sim::symmetric_rig(baseline_m, toe_in_rad, 600.0, 1280, 1024);
  scene.target.normal = sim::facing_normal(theta_rad, gamma_rad);
  scene.target.ring_centre_m = {0.0, 0.0, range_m};
  return scene;
}

/// Every scene of the paper's section 3, and attitudes to 25 degrees about both axes.
inline std::vector<Scene> paper_scenes() {
  std::vector<Scene> scenes;
  const double one = 1.0 * kDeg;
  for (int mm = 2600; mm >= 1000; mm -= 100) scenes.push_back(scene_of(one, one, 3.0, mm * 1e-3));
  for (int deg = 30; deg >= 0; deg -= 2) scenes.push_back(scene_of(one, one, 3.0, 1.8, deg * kDeg));
  for (int mm = 3000; mm >= 1600; mm -= 100) scenes.push_back(scene_of(one, one, mm * 1e-3));
  for (int tenth = 0; tenth <= 50; tenth += 5) {
    scenes.push_back(scene_of(0.0, tenth * 0.1 * kDeg));
    scenes.push_back(scene_of(tenth * 0.1 * kDeg, 0.0));
    scenes.push_back(scene_of(tenth * 0.1 * kDeg, (5.0 - tenth * 0.1) * kDeg));
  }
  for (int theta = -25; theta <= 25; theta += 5) {
    for (int gamma = -25; gamma <= 25; gamma += 5) scenes.push_back(scene_of(theta * kDeg, gamma * kDeg));
  }
  return scenes;
}

inline Rig core_rig(const sim::StereoRig& from) {
  Rig rig;
  for (std::size_t v = 0; v < kViews; ++v) {
    const sim::StereoCamera& camera = from[v];
    rig.views[v].optics = {camera.width_px, camera.height_px, camera.fx_px,     camera.fy_px,
                           camera.cx_px,    camera.cy_px,     camera.distortion};
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

inline double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace pharos::ring2
