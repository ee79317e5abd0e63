// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "host/calibrate/lighthouse_calibration.hpp"
#include "tools/sim/lighthouse_simulator.hpp"

namespace pharos::calibrate::test {

/// One simulated calibration session: the paper's target stationary in random poses, *workshop* errors.
struct Session {
  std::uint64_t seed = 1;
  int poses = 30;
  double rest_s = 2.0;  // in each pose, and 0.2 s without light
  double min_range_m = 1.0;
  double max_range_m = 3.0;
  int stations = 1;
};

sim::LighthouseScenario scenario_of(const Session& session);

/// The simulator's light, decoded, with the stations' calibrations from OOTX.
RecordingLog record(sim::LighthouseSimulator& simulator);

/// The true length between two sensors; `error_sigmas`: error of the measurement.
MeasuredLength measured(const Target& target, std::uint8_t a, std::uint8_t b, double sigma_m,
                        double error_sigmas = 0.0);

/// A recorded session, with one length known to 0.02 mm (its error is drawn from the seed).
LighthouseCalibrationInput calibration_input(sim::LighthouseSimulator& simulator, std::uint64_t seed);

/// Estimate minus truth. Sensors are compared in shape: without the rigid motion, which no recording determines.
struct Truth {
  double shape_rms_m = 0.0;  // over sensors, of the length of the error
  double shape_worst_m = 0.0;
  double phase_worst_rad = 0.0;
  // Normalised squared errors per degree of freedom, by the stated covariance: of the shape, of the rotors, of both.
  double nees_shape = 0.0;
  double nees_rotors = 0.0;
  double nees = 0.0;
  int freedom = 0;  // of the last
};

Truth compare(const LighthouseCalibration& calibration, const sim::LighthouseSimulator& simulator);

}  // namespace pharos::calibrate::test
