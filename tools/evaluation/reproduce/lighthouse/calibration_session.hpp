// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"

namespace pharos::tools {

/// Calibration of a target before its flight: stationary intervals in random poses 1 to 3 m from the station, and one
/// length between sensors known to 0.02 mm.
struct CalibrationSession {
  int poses = 30;
  double rest_s = 2.0;
};

/// Result of the calibration of `run`'s target and station, with the same errors, which the seed determines.
RunAssumptions calibrate_for(const SimulatedRun& run, const CalibrationSession& session, std::uint64_t seed);

}  // namespace pharos::tools
