// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"

namespace pharos::ring2 {

inline constexpr double kDeg = kRadPerDeg;

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

inline double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace pharos::ring2
