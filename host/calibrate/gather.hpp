// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/lighthouse_calibration.hpp"

namespace pharos::calibrate {

/// The stationary intervals of all recordings, and the stations seen in them.
struct Gathered {
  std::vector<StationaryAverage> intervals;
  std::vector<lighthouse::StationCalibration> stations;  // the first is seen in most intervals
  std::size_t unknown_sensors = 0;                       // sensors hit that are not in the target's table
};

/// Finds, averages and weighs the stationary intervals. Throws host::InputError as calibrate_lighthouse.
Gathered gather(const LighthouseCalibrationInput& input);

}  // namespace pharos::calibrate
