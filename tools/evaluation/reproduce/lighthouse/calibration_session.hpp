// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"

namespace pharos::tools {

/// How a target is calibrated before it flies: rests in random poses 1 to 3 m before the station, and one length
/// between sensors known to 0.02 mm.
struct CalibrationSession {
  int poses = 30;
  double rest_s = 2.0;
};

/// What the calibration of `run`'s target and station says: of the same errors, which the seed decides.
RunAssumptions calibrate_for(const SimulatedRun& run, const CalibrationSession& session, std::uint64_t seed);

}  // namespace pharos::tools
