// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "pharos/base/units.hpp"
#include "tests/target/vectors/draw.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::test {

/// A view of the frustum between 1 and 5 m, within some 45 deg of straight ahead, that at least four sensors see.
inline LighthouseFromBody draw_view(const Target& target, Draw& draw) {
  LighthouseFromBody pose;
  do {
    // One draw a statement: compilers choose the order of a call's arguments.
    pose.t.z() = 3.0 + 2.0 * draw.real();
    pose.t.x() = pose.t.z() * draw.real();
    pose.t.y() = pose.t.z() * draw.real();
    Quaternion q;
    for (int i = 0; i < 4; ++i) q.coeffs()[i] = draw.real();
    pose.R = q.normalized().toRotationMatrix();
  } while (pose::visible_sensors(target, pose).count() < 4);
  return pose;
}

// 0.2 arcsec: far more than the difference of two mathematical libraries, so that both machines get the same angles.
inline constexpr double kGrid_rad = 0x1p-20;

/// Bearings of the visible sensors, with noise, rounded to the grid.
inline pose::Observations observe(const Target& target, const LighthouseFromBody& pose, double sigma_rad, Draw& draw) {
  const auto seen = pose::visible_sensors(target, pose);
  pose::Observations observations;
  for (const SensorPlacement& s : target) {
    if (!seen.test(s.sensor)) continue;
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const double noise = 1.7 * sigma_rad * draw.real();  // uniform, of this standard deviation
      const double theta = bearing_of(pose * s.position_m, axis) + noise;
      observations.push_back({s.sensor, axis, kGrid_rad * static_cast<double>(std::llround(theta / kGrid_rad))});
    }
  }
  return observations;
}

}  // namespace pharos::test
