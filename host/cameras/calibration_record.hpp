// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pharos::host {

/// Statistics and covariance of a calibration, as stored in its file.
struct CalibrationRecord {
  std::int64_t images = 0;  // used: of a rig, pairs
  std::int64_t points = 0;  // in them: of a rig, in both cameras together
  double rms_px = 0.0;      // of the distances between found and predicted points
  std::vector<std::string> parameters;
  std::vector<std::vector<double>> covariance;  // of the parameters, in their order and units
  std::vector<std::string> unobservable;        // what the images do not determine, as text
};

}  // namespace pharos::host
