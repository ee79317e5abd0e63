// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "host/calibrate/mounting/mounting_calibration.hpp"

namespace pharos::calibrate {

/// Poses are base.moved_by(delta); the adjustment works on delta, which is moved into the base after each round.
struct UnknownPose {
  Matrix3 R = Matrix3::Identity();
  Vector3 t = Vector3::Zero();
  std::array<double, 6> delta{};

  void settle() {
    R = orthonormalised(rotation_exp({delta[0], delta[1], delta[2]}) * R);
    t += Vector3(delta[3], delta[4], delta[5]);
    delta = {};
  }
};

/// A source's unknowns and their priors (1 sigma; the value before is where the prior is centred).
struct UnknownSource {
  UnknownPose sensor, feature;
  double time_offset_s = 0.0;
  double scale = 0.0;                       // positions are (1 + scale) times the true ones
  std::vector<std::array<double, 6>> slow;  // at begin_s + i * slow_step_s
  bool fixed = false;                       // the given source
  UnknownPose prior_sensor, prior_feature;
  Matrix6 prior_sensor_covariance, prior_feature_covariance;
  double prior_offset_s = 0.0, prior_offset_sigma_s = 1.0;
  double scale_sigma = 0.0;  // 0: no unknown
};

/// Everything that is adjusted: sources, and the target's motion as a cumulative cubic B-spline of poses.
struct MountingUnknowns {
  double begin_s = 0.0, knot_s = 0.4;
  std::vector<UnknownPose> motion;  // control points; a time t lies in segment floor((t - begin) / knot)
  double slow_step_s = 15.0;
  std::vector<UnknownSource> sources;

  std::size_t segments() const { return motion.size() - 3; }
};

}  // namespace pharos::calibrate
