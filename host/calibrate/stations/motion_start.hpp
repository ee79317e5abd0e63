// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/stations/body_spline.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::calibrate {

/// What the tracker says of a recording.
struct TrackedMotion {
  std::vector<BodySpline> pieces;  // of 0.3 to 1 s, without a gap
  double seconds() const;
};

/// Runs the tracker of `pharos track --sweeps` with these stations, all held to be wrong by `unstated` where they state
/// no sigmas.
TrackedMotion track_motion(const std::vector<network::PlaneSweep>& sweeps, const network::Stations& stations,
                           const Target& target, const network::StationSigmas& unstated);

}  // namespace pharos::calibrate
