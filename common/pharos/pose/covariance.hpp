// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/linearise.hpp"

namespace pharos::pose {

/// H of (18): the pose's covariance per unit variance of one bearing, for the error of Pose::moved_by.
///
/// (J^T J)^-1 J^T D R_theta D J (J^T J)^-1 with R_theta of (19): correlation rho between sensors of one rotor, none
/// across rotors. D is the unit matrix for Residual::kAngle; for Residual::kTangent it carries the bearing's noise to
/// the tangent, 1/sin^2(theta). With rho = 0 and angles it is (J^T J)^-1. `normal` is the fit's.
Matrix6 unit_covariance(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual, double rho,
                        const NormalEquations& normal);

/// A pivot of J^T J below this fraction of its diagonal means that the rows leave a direction unconstrained: rounding
/// alone leaves 1e-16, the worst view of a valid target 1e-7.
inline constexpr double kDegeneratePivotRatio = 1e-11;

/// (22): square root of the trace of the rotation block, degrees per rad of bearing noise. The left error's covariance
/// is the paper's J_r H_phi J_r^T already.
double adop_of(const Matrix6& unit_covariance);
/// (22): square root of the trace of the translation block, metres per rad of bearing noise.
double pdop_of(const Matrix6& unit_covariance);

}  // namespace pharos::pose
