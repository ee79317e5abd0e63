// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/covariance.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::pose {
namespace {

// Inverse of a factored matrix, column by column.
Matrix6 inverse_of(const PackedSymmetric<6>& matrix) {
  const Factorisation<6> factor(matrix);
  Matrix6 inverse;
  for (int j = 0; j < 6; ++j) {
    std::array<double, 6> unit{};
    unit[static_cast<std::size_t>(j)] = 1.0;
    const std::array<double, 6> column = factor.solve(unit);
    for (int i = 0; i < 6; ++i) inverse(i, j) = column[static_cast<std::size_t>(i)];
  }
  return 0.5 * (inverse + inverse.transpose());
}

// Effect of one bearing's noise on its residual: D of the sandwich.
double noise_gain(const ObservationTable& table, int sensor, int axis, Residual residual) {
  if (residual == Residual::kAngle) return 1.0;
  const double sine = table.axis[static_cast<std::size_t>(axis)].sine[static_cast<std::size_t>(sensor)];
  return 1.0 / (sine * sine);
}

// J^T D R_theta D J = (1 - rho) sum d^2 j j^T + rho (s_x s_x^T + s_y s_y^T), s = sum of d j over a rotor's rows.
Matrix6 middle_of(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual, double rho) {
  Matrix6 middle = Matrix6::Zero();
  for (int a = 0; a < kAxes; ++a) {
    Vector6 sum = Vector6::Zero();
    for (int i = 0; i < table.count; ++i) {
      const Axis axis = static_cast<Axis>(a);
      if (!table.seen(i, axis)) continue;
      const Vector6 row = noise_gain(table, i, a, residual) * row_of(table, i, axis, pose, residual).jacobian;
      middle += (1.0 - rho) * row * row.transpose();
      sum += row;
    }
    middle += rho * sum * sum.transpose();
  }
  return middle;
}

}  // namespace

Matrix6 unit_covariance(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual, double rho,
                        const NormalEquations& normal) {
  const Matrix6 inverse = inverse_of(normal.matrix);
  if (residual == Residual::kAngle && rho == 0.0) return inverse;
  const Matrix6 sandwich = inverse * middle_of(table, pose, residual, rho) * inverse;
  return 0.5 * (sandwich + sandwich.transpose());
}

double adop_of(const Matrix6& unit_covariance) {
  return kDegPerRad * std::sqrt(unit_covariance.topLeftCorner<3, 3>().trace());
}

double pdop_of(const Matrix6& unit_covariance) { return std::sqrt(unit_covariance.bottomRightCorner<3, 3>().trace()); }

}  // namespace pharos::pose
