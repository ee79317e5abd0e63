// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/stations/body_spline.hpp"

namespace pharos::calibrate {

/// Specific force that the body's accelerometer felt, body frame: upwards where it stands still.
struct Acceleration {
  double time_s = 0.0;
  Vector3 f_m_s2 = Vector3::Zero();
};

struct Up {
  Vector3 direction = Vector3::Zero();  // unit, world; zero where fewer than three pieces have samples
  double sigma_rad = 0.0;               // from the scatter of the pieces of motion
};

/// Against gravity: over the pieces of motion, mean of R f - a = g + R bias by robust least squares, the bias of the
/// body (accelerometer and mounting) known to 0.4 m/s^2 before.
Up up_of(const std::vector<BodySpline>& motion, const std::vector<Acceleration>& samples);

}  // namespace pharos::calibrate
