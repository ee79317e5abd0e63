// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>

#include "pharos/base/capacity.hpp"
#include "pharos/base/result.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::pose {

/// By sensor number.
using SensorSet = std::bitset<kMaxSensors>;

/// Incidence up to which a photodiode is assumed to see the station, rad: the value behind the published figures. A
/// sensor without a normal is always assumed to see it.
inline constexpr double kVisibleIncidence_rad = 60.0 * kRadPerDeg;

/// Sensors of the target that face the station at this pose. Self-occlusion of the body is not modelled: a convex body
/// has none within 60 deg.
SensorSet visible_sensors(const Target& target, const LighthouseFromBody& pose,
                          double incidence_limit_rad = kVisibleIncidence_rad);

/// Precision of a view before anything is measured: (18) and (22).
struct Precision {
  /// H of (18), for the error of Pose::moved_by: rad^2, m^2 per rad^2 of bearing variance.
  Matrix6 unit_covariance = Matrix6::Zero();
  double adop_deg_per_rad = 0.0;
  double pdop_m_per_rad = 0.0;
};

/// Precision of the pose from both bearings of `sensors`, correlated by rho within a rotor.
/// Errors: kTooFewSensors (fewer than three), kDegenerate, kBehindStation (any of them), kBadInput (not finite).
Result<Precision, Refusal> precision_of(const Target& target, const LighthouseFromBody& pose, const SensorSet& sensors,
                                        double rho);

}  // namespace pharos::pose
