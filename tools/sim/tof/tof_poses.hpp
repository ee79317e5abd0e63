// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/sim/random_stream.hpp"
#include "tools/sim/tof/pixel_rays.hpp"
#include "tools/sim/tof/satellite.hpp"

namespace pharos::sim {

/// Angles (8) of paper 000, degrees: diag(1, -1, -1) R_C_T = Rx(alpha) Ry(beta) Rz(gamma). All zero: the ring faces the
/// camera and X' points right; gamma -40 turns X' 40 deg clockwise in the picture.
struct PaperAngles {
  double alpha_deg = 0.0;
  double beta_deg = 0.0;
  double gamma_deg = 0.0;
};

Matrix3 attitude_of(const PaperAngles& angles);
PaperAngles angles_of(const Matrix3& R_camera_target);

/// Where random poses may lie.
struct RandomPoses {
  int count = 1;
  double min_range_m = 2.5;  // of the ring's centre from the camera
  double max_range_m = 6.0;
  double max_tilt_deg = 35.0;  // of the ring's normal from the line of sight
  double margin_px = 8.0;      // ring and connectors stay this far inside the image
};

/// Range, tilt and turn uniform; the direction uniform over the picture among those that keep ring and connectors in
/// it. Throws host::InputError where 10,000 draws give none.
std::vector<CameraFromTarget> random_poses(const RandomPoses& limits, const Satellite& satellite, const PixelRays& rays,
                                           RandomStream random);

/// From one pose to another at constant speed and turning rate, while the body spins about Z' and Z' nods.
struct Approach {
  CameraFromTarget from;
  CameraFromTarget to;
  double duration_s = 10.0;
  double spin_deg_s = 0.0;
  double nod_deg = 0.0;
  double nod_period_s = 10.0;

  CameraFromTarget at(double time_s) const;
};

}  // namespace pharos::sim
