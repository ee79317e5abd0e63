// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::host {

/// A constant angular velocity, in the left camera's frame.
struct SpinEstimate {
  Vector3 rate_rad_s = Vector3::Zero();
  Matrix3 covariance = Matrix3::Zero();  // (rad/s)^2
  Vector3 axis = Vector3::Zero();        // unit; zero where the rate does not differ significantly from zero
  double sigma_rate_rad_s = 0.0;
  double sigma_axis_rad = 0.0;
  double residual_rms_rad = 0.0;
  int attitudes = 0;
  double span_s = 0.0;
};

/// Rotation of the target of a stereo rig: content of a spin_t.
struct SpinReport : MeasurementHeader {
  SpinEstimate spin;
};

const char* channel_of(const SpinReport& report);
bool is_finite(const SpinReport& report);

}  // namespace pharos::host
