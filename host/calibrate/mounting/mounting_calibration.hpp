// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/mounting/mounting.hpp"
#include "host/mounting/source_table.hpp"

namespace pharos::calibrate {

/// Poses of one source, in the order of their times.
struct MountingRecording {
  std::string name;  // as in the mounting's file
  host::SourceKind kind = host::SourceKind::kLighthouse;
  std::vector<host::SourceRow> rows;
  /// 1 sigma of errors that last for seconds and minutes, and so do not average out over a recording: of each axis.
  double slow_rotation_rad = 3.5e-4;
  double slow_position_m = 4e-4;
};

struct MountingCalibrationInput {
  std::vector<MountingRecording> recordings;
  /// Index of the recording whose mounting and feature frame define vehicle and target frame.
  std::size_t given = 0;
  /// What is known before: start values, and what stays of directions that the recording does not tell. A source that
  /// is absent starts from the recording alone, with vague priors (1 rad, 5 m, 1 s). The given source's is taken over;
  /// absent, vehicle frame = its sensor frame and target frame = its feature frame.
  std::optional<host::Mounting> prior;
  double max_offset_s = 0.5;    // of the time offsets searched
  double knot_spacing_s = 0.4;  // of the target's motion
  double slow_time_constant_s = 30.0;
};

/// One source's residuals after the adjustment.
struct MountingResidual {
  double time_s = 0.0;               // on the vehicle's clock
  Vector3 rotation_rad, position_m;  // measured minus predicted, in the sensor frame, slow error removed
  // Stated for them: traces.
  double rotation_variance_rad2 = 0.0, position_variance_m2 = 0.0;
  bool used = true;  // false: left out as an outlier
};

struct MountingFit {
  std::size_t used = 0, outliers = 0, ambiguous = 0, outside = 0;  // rows
  double rms_rotation_rad = 0.0, rms_position_m = 0.0;             // of the rows used, root of the sum of three axes
  double chi2_per_freedom = 0.0;  // before the covariances were enlarged by it, if above 1
  std::vector<MountingResidual> residuals;
};

struct MountingCalibration {
  host::Mounting mounting;
  std::vector<MountingFit> fits;  // of mounting.sources
  double seconds = 0.0;
  Vector3 turn_rad = Vector3::Zero();  // root mean square of the target's rotation about its principal axes, descending
  bool converged = false;
};

/// Hand-eye calibration of all sources at once (README.md): T_vehicle_sensor, T_target_feature and time offset of each
/// source, from recordings in which they see the same target move, with full covariance.
///
/// Throws host::InputError: fewer than two sources, a source without rows in the given source's time, a target that
/// does not turn or turns about one axis only while no prior is given, a given source without turn.
///
/// Cost: a minute of four sources (3,000 poses) a few seconds.
MountingCalibration calibrate_mounting(const MountingCalibrationInput& input);

}  // namespace pharos::calibrate
