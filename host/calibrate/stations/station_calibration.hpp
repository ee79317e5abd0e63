// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/stations/gravity.hpp"
#include "host/calibrate/stations/station_bundle.hpp"
#include "host/calibrate/stations/station_log.hpp"

namespace pharos::calibrate {

struct StationCalibrationInput {
  NetworkLog log;
  network::Stations stations;  // calibration as sent or zero, poses where they are known
  Target target;               // nominal
  double sensor_sigma_m = 0.2e-3;
  std::vector<Acceleration> accelerations;  // not empty: the world's z is turned up
};

/// What is left of a plane's sweeps.
struct PlaneFit {
  std::size_t sweeps = 0;
  std::size_t outliers = 0;  // of those, whose mean is off by more than five times the middle deviation
  double mean_rad = 0.0;     // RMS of the sweeps' means over the sensors, without outliers
  double own_rad = 0.0;      // RMS of the hits about them
};

/// A parameter's estimate.
struct StationParameter {
  std::string name;          // "station 1 plane b tilt", "station 1 x_m", "sensor 3 x_m"
  double prior_sigma = 0.0;  // 0: none
  double prior = 0.0, value = 0.0, sigma = 0.0;
};

struct StationCalibration {
  network::Stations stations;                                // that were heard, with sigmas
  std::vector<std::array<PlaneFit, network::kPlanes>> fits;  // by station
  std::vector<StationParameter> parameters;
  Target sensors;
  std::optional<double> up_sigma_rad;  // of the world's z, where it was turned up
  /// Relative 1 sigma of every length of the room, from the target's size.
  double scale_sigma = 0.0;
  double seconds = 0.0;  // of motion that was used
  std::size_t pieces_left_out = 0, sweeps = 0, hits = 0, hits_left_out = 0;
  bool from_scratch = false;  // poses of the file were not there or not useful
  bool converged = false;
};

/// Poses and calibration of stations from a recording of a target that is carried around: the tracker's motion as
/// splines, adjusted with all stations, tracked again with these, adjusted without the pieces that do not fit.
///
/// The world: the first station heard keeps the pose that it is given, or is its origin; then it is turned up if asked.
/// Scale: the target's size alone. Throws host::InputError, one line that says what to do: fewer than two stations
/// that were heard, no motion, too little time in which two saw the target. Some 20 s for a minute of light.
StationCalibration calibrate_stations(const StationCalibrationInput& input);

}  // namespace pharos::calibrate
