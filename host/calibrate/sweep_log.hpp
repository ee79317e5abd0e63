// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/base/axis.hpp"
#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::calibrate {

/// One hit as a raw angle, before the station model.
struct LoggedHit {
  std::uint8_t sensor = 0;
  double raw_rad = 0.0;
};

/// One lit sweep, as held in memory for a whole recording.
struct LoggedSweep {
  std::int64_t flash_ticks = 0;
  std::uint8_t slot = 0;  // which flash of the cycle, as Flash::station
  Axis axis = Axis::kX;
  std::vector<LoggedHit> hits;
};

/// One recording as the calibration needs it: about 0.3 MiB a minute of 12 sensors.
struct RecordingLog {
  std::string name;                 // for messages
  std::vector<LoggedSweep> sweeps;  // in order of time
  /// Calibration of each slot's station, from OOTX or from a file; empty where unknown.
  std::array<std::optional<lighthouse::StationCalibration>, kMaxStations> station;

  /// Adds a decoded sweep. Sweeps of dark slots and of uncertain time zero (a weak flash, a nominal period) are
  /// left out. Angles are from the flash as measured: smoothing would correlate the noise of neighbouring rotor turns.
  void push(const lighthouse::Sweep& sweep);
};

}  // namespace pharos::calibrate
