// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/calibrate/stations/station_calibration.hpp"

namespace pharos::calibrate {

/// Where the target was: centre, and standard deviations along the principal axes, the largest first.
struct Spread {
  Vector3 centre_m = Vector3::Zero();
  Vector3 sigma_m = Vector3::Zero();
};
Spread spread_of(const StationUnknowns& unknowns);

/// Stations with their sigmas, parameters, residuals and scale of the last adjustment.
void fill_report(const network::Stations& prior, const Target& nominal, const std::vector<UsedSweep>& sweeps,
                 double sensor_sigma_m, const StationBundleResult& result, StationCalibration& out);

}  // namespace pharos::calibrate
