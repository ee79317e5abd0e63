// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/calibrate/stations/station_calibration.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// The stations' file: what `pharos track --stations` reads, with a head that says gauge and scale.
std::string stations_text(const calibrate::StationCalibration& calibration);
/// A row a parameter: parameter,prior,value,prior_sigma,sigma,told.
void write_station_parameters(const calibrate::StationCalibration& calibration, const OutputOptions& options);
/// On standard error: what was used, residuals a plane, scale, what the recording does not tell.
void note_stations(const calibrate::StationCalibration& calibration);

}  // namespace pharos::tools
