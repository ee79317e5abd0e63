// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "host/calibrate/stations/station_unknowns.hpp"

namespace pharos::calibrate {

/// What is known of stations together, beside the place of the target.
struct StationErrors {
  std::vector<network::ErrorModes> modes;                      // by station
  std::vector<std::array<double, network::kPlanes>> left_rad;  // of each plane: what is no turn of its station, 1 sigma
};

/// Independent errors of the stations from the covariance of an adjustment (StationBundleResult::covariance).
///
/// The fields of a station's planes are as a turn of the station, by least squares over the places where the target
/// was. A motion of all stations and the target together is no error: the modes leave these places where they are,
/// on the whole (an S-transformation: Baarda 1973).
StationErrors station_errors(const StationUnknowns& at, const Eigen::MatrixXd& covariance);

}  // namespace pharos::calibrate
