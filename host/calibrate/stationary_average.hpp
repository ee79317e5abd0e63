// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/calibrate/stationary_search.hpp"
#include "host/calibrate/sweep_log.hpp"

namespace pharos::calibrate {

/// One sensor's raw angle on one rotor, averaged over a stationary interval. A sensor with reflections has several:
/// candidates.
struct MeanBearing {
  std::uint8_t sensor = 0;
  double raw_rad = 0.0;
  int sweeps = 0;               // averaged
  double own_square_sum = 0.0;  // of the part not common to the sweep's sensors, rad^2
  double own_sigma_rad = 0.0;   // of raw_rad, without the part common to the rotor; from weigh()
};

/// Bearings of one rotor during one stationary interval.
struct RotorView {
  std::size_t station = 0;  // index among the calibration's stations
  Axis axis = Axis::kX;
  int sweeps = 0;
  double common_square_sum = 0.0;  // of the part common to all sensors of a sweep, rad^2
  double common_sigma_rad = 0.0;   // of the mean of that part; from weigh()
  std::vector<MeanBearing> bearings;
};

/// Averages of one stationary interval.
struct StationaryAverage {
  std::size_t recording = 0;
  double from_s = 0.0;  // by the recording's own counter
  double to_s = 0.0;
  std::vector<RotorView> rotors;
};

/// Averages one stationary interval. Angles of one sensor that differ by 150 arcsec and more between neighbours are
/// separate candidates when at least three tenths of the sweeps show them. `station_of_slot`: index by slot.
StationaryAverage average_interval(const RecordingLog& recording, std::size_t recording_index,
                                   const StationaryInterval& interval, std::span<const std::size_t> station_of_slot);

/// Sets the sigma of every mean from the scatter of the recordings themselves.
///
/// An angle's noise is a part common to all sensors of the sweep (flash and rotor: correlation 0.87 to 0.99) and one of
/// its own. The common part's variance is that of its rotor over all intervals; the own part's is that of the sensor in
/// this interval, regularised towards its rotor's mean where there are few sweeps (a weight of twenty sweeps).
void assign_sigmas(std::vector<StationaryAverage>& intervals);

}  // namespace pharos::calibrate
