// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/calibrate/stations/station_log.hpp"
#include "pharos/geometry/target.hpp"
#include "tools/evaluate/position_track.hpp"

namespace pharos::tools {

/// One log with its motion capture.
struct PositioningLog {
  std::string name;  // "lh1 flight log01"
  int generation = 1;
  std::string kind;            // flight, move, jitter
  network::Stations stations;  // as logged
  Target target;
  calibrate::NetworkLog light;
  evaluate::PositionTrack crossing_beams;
  evaluate::PositionTrack truth;
  std::pair<double, double> marks_s;  // on the log's clock, of the truth's first and last row
};

/// All logs of a folder that have their motion capture, in the order of names. Throws host::InputError where there is
/// none.
std::vector<PositioningLog> read_positioning_logs(const std::string& folder);

/// What `pharos track --sweeps` answers `ok` with these stations.
evaluate::PositionTrack tracked_positions(const PositioningLog& log, const network::Stations& stations);

}  // namespace pharos::tools
