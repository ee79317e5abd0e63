// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/lighthouse_calibration.hpp"

namespace pharos::calibrate {

/// The stills of all recordings, and the stations that they show.
struct Gathered {
  std::vector<StationaryAverage> intervals;
  std::vector<lighthouse::StationCalibration> stations;  // the first is seen in most stills
  std::size_t unknown_sensors = 0;                       // sensors hit that the target has not
};

/// Finds, averages and weighs the stills. Throws host::InputError as calibrate_lighthouse.
Gathered gather(const LighthouseCalibrationInput& input);

}  // namespace pharos::calibrate
