// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/packed_symmetric.hpp"
#include "pharos/pose/observation_table.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::pose {

/// Sums of one linearisation: J^T J, J^T r and r^T r over the rows that take part.
///
/// Unknowns: the error delta of Pose::moved_by (rotation rad, then translation m, both in the lighthouse frame), so
/// that d p = delta_rot x (R b) + delta_trans. Residual::kAngle: r = theta(pose) - theta(measured), rad, exact (not its
/// sine or tangent). Residual::kTangent: the paper's (6), r = x/z - cot(theta).
struct NormalEquations {
  PackedSymmetric<6> matrix;
  std::array<double, 6> gradient;
  double cost;
};

/// Cost: about 25 ns a sensor.
NormalEquations linearise(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual);

/// r^T r alone.
double cost_of(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual);

/// One row: its residual and its derivatives by delta.
struct Row {
  double residual;
  Vector6 jacobian;
};
Row row_of(const ObservationTable& table, int sensor, Axis axis, const LighthouseFromBody& pose, Residual residual);

/// Derivatives of one bearing theta of a body point by delta.
Vector6 jacobian_of(const Vector3& body_m, Axis axis, const LighthouseFromBody& pose);

/// Residual angle (rad, in (-pi, pi]) of a point in the lighthouse frame against a bearing given by cosine and sine.
double angle_residual(double along, double ahead, double cosine, double sine);

}  // namespace pharos::pose
