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
  Vector3 direction = Vector3::Zero();  // unit, world; zero where there are fewer than a second of samples
  double sigma_rad = 0.0;               // from the scatter of the pieces of motion
};

/// The direction of the mean of R f - a over all samples within the motion: what is left is against gravity.
Up up_of(const std::vector<BodySpline>& motion, const std::vector<Acceleration>& samples);

}  // namespace pharos::calibrate
