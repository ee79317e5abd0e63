// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"

namespace pharos::tools {

// Section 3 of paper 001: 1.12 m and 0.297 m across, 0.5 m apart, f = 600.
inline constexpr double kRing2Focal_px = 600.0;
inline constexpr double kRing2Range_m = 3.0;
inline constexpr double kRing2Baseline_m = 1.8;
inline constexpr double kRing2ToeIn_deg = 20.0;

/// The target turned by theta about X and gamma about Y before the paper's rig.
inline ring2::Scene paper_scene(double theta_deg, double gamma_deg, double range_m = kRing2Range_m,
                                double baseline_m = kRing2Baseline_m, double toe_in_deg = kRing2ToeIn_deg) {
  ring2::Scene scene;
  scene.rig = sim::symmetric_rig(baseline_m, toe_in_deg * kRadPerDeg, kRing2Focal_px, 1280, 1024);
  scene.target.normal = sim::facing_normal(theta_deg * kRadPerDeg, gamma_deg * kRadPerDeg);
  scene.target.ring_centre_m = {0.0, 0.0, range_m};
  return scene;
}

}  // namespace pharos::tools
