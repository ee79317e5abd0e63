// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/mounting/mounting_calibration.hpp"
#include "host/calibrate/mounting/mounting_unknowns.hpp"

namespace pharos::calibrate {

/// A row that takes part, with the places of the spline and of the slow error that it falls into.
struct UsedRow {
  std::size_t source = 0, row = 0;
  std::size_t segment = 0, slow = 0;
};

/// The rows within the motion at the unknowns' time offsets, without those marked as outliers.
std::vector<UsedRow> select_rows(const MountingCalibrationInput& input, const MountingUnknowns& unknowns,
                                 const std::vector<std::vector<bool>>& usable);

/// One adjustment with these rows by Ceres; `enlarged` multiplies each source's covariances. Moves the unknowns. True
/// where it converged.
bool adjust(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
            const std::vector<double>& enlarged, MountingUnknowns& unknowns);

/// Covariance of each source that is not fixed, of (sensor, feature, time offset): 13 x 13, at the present unknowns,
/// the motion, slow errors and scales eliminated. Zero of the fixed one.
using SourceCovariance = Eigen::Matrix<double, 13, 13>;
std::vector<SourceCovariance> covariances(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
                                          const std::vector<double>& enlarged, MountingUnknowns& unknowns);

/// What the rows say of a source's slow error: its squares in units of the process' own innovations, summed over nodes
/// and axes, and how many of these the rows tell (the others are the assumption's).
struct SlowEvidence {
  double rotation_rad2 = 0.0, rotation_freedom = 0.0;
  double position_m2 = 0.0, position_freedom = 0.0;
};
std::vector<SlowEvidence> slow_evidence(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
                                        const std::vector<double>& enlarged, MountingUnknowns& unknowns);

/// Residual of a row at the unknowns and its square in units of its covariance.
struct RowResidual {
  double time_s = 0.0;
  Vector3 rotation_rad, position_m;
  double chi2 = 0.0;
};
RowResidual residual_of(const MountingCalibrationInput& input, const UsedRow& row, const MountingUnknowns& unknowns);

}  // namespace pharos::calibrate
