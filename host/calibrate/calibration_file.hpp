// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/calibrate/lighthouse_calibration.hpp"
#include "host/stations/station_file.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/motion/hypothesis.hpp"
#include "pharos/tracking/station_survey.hpp"

namespace pharos::calibrate {

/// What a file of calibrations says: stations alone (host/stations), or with the target that was calibrated with them.
struct CalibrationFile {
  std::string name;  // for messages
  std::vector<host::StationEntry> stations;
  Target sensors;                  // as calibrated; empty: of stations only
  std::vector<Vector3> nominal_m;  // of each of them, as the target's table gave it
  double scale_sigma = 0.0;        // relative, of the target's size and so of every range
  int model_form = 0;              // 0: the file does not say
  std::optional<tracking::CalibratedPair> pair;
  std::vector<std::string> parameters;
  std::vector<std::vector<double>> covariance;

  bool has_target() const { return !sensors.empty(); }
};

/// Reads a calibration (`-`: standard input). Throws InputError naming file, line and key.
CalibrationFile read_calibration_file(const std::string& path);

/// The same from text; `name` stands for the file in messages.
CalibrationFile parse_calibration(std::string_view text, const std::string& name);

/// `nominal` with the calibrated positions; `nominal` itself where the file holds no target. Throws InputError where
/// the file is of another target: other sensor numbers, or positions other than those that it was calibrated from (1
/// mm).
Target calibrated_target(const CalibrationFile& file, const Target& nominal);

/// What a file leaves wrong with sensors and rotors, from its own covariance: root mean squares over the sensors' axes
/// (their common size, which widen_by_scale() counts, taken out) and over all rotors in directions to 30 deg off axis.
/// Where it holds no covariance, what calibrations usually leave; of stations only, what nobody calibrated.
motion::SystematicErrors systematic_errors(const CalibrationFile& file);

/// A pose's covariance with what the target's uncertain size puts on its range.
void widen_by_scale(LighthousePoseEstimate& estimate, double scale_sigma);

/// The file of a calibration, which read_calibration_file reads back exactly. README.md says what it holds.
std::string calibration_text(const LighthouseCalibration& calibration, const Target& nominal);

}  // namespace pharos::calibrate
