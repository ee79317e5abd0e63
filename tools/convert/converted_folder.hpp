// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pharos/geometry/target.hpp"
#include "pharos/network/station.hpp"
#include "tools/convert/libsurvive_record.hpp"
#include "tools/convert/light_hit.hpp"

namespace pharos::convert {

/// What a conversion writes.
struct ConvertedLog {
  network::Stations stations;
  int generation = 1;  // of the hits
  std::vector<LightHit> hits;
  Target target;
  std::vector<ImuSample> imu;
  std::vector<CrossingBeam> crossing_beams;
  std::vector<LogEvent> events;
  std::vector<ExternalPose> external;
};

/// Writes sweeps.csv, stations.toml and target.csv, and imu.csv, crossing_beam.csv, events.csv and external_pose.csv
/// where the log has them, to a folder, which is made. Throws InputError where it cannot be written.
void write_folder(const std::string& folder, const ConvertedLog& log);

}  // namespace pharos::convert
