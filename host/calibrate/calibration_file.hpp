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

/// Contents of a calibration file: stations alone (host/stations), or with the target that was calibrated with them.
struct CalibrationFile {
  std::string name;  // for messages
  std::vector<host::StationEntry> stations;
  Target sensors;                  // as calibrated; empty: of stations only
  std::vector<Vector3> nominal_m;  // of each of them, from the target's table
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

/// Remaining systematic errors of sensors and rotors, from the file's own covariance: root mean squares over the
/// sensors' axes (without their common scale, which widen_by_scale() counts) and over all rotors in directions to 30
/// deg off axis. Where the file holds no covariance, typical values of a calibration; where it holds stations only,
/// those of an uncalibrated target.
motion::SystematicErrors systematic_errors(const CalibrationFile& file);

/// A pose's covariance, increased by the effect of the target's uncertain size on its range.
void widen_by_scale(LighthousePoseEstimate& estimate, double scale_sigma);

/// Text of a calibration's file; read_calibration_file reads the same values from it. README.md describes the format.
std::string calibration_text(const LighthouseCalibration& calibration, const Target& nominal);

}  // namespace pharos::calibrate
