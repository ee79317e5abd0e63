// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "tools/sim/tof/ideal_frame.hpp"
#include "tools/sim/tof/satellite.hpp"
#include "tools/sim/tof/sensor.hpp"
#include "tools/sim/tof/tof_poses.hpp"

namespace pharos::sim {

/// A scenario of the time-of-flight simulator: what a TOML file says (read_tof_scenario), or what a program fills in.
/// Defaults are those of the file; README.md lists keys and where the numbers come from.
struct TofScenario {
  double frames_per_s = 30.0;
  Lens lens = kPaperLens;
  DepthScale depth;
  ImagingModel imaging;
  SensorModel sensor;
  Satellite satellite = satellite_of_ring(1.1);
  /// Where the target is in each frame, in the order of frames.
  std::vector<CameraFromTarget> poses;
  /// The occluder's direction is drawn anew for each frame, away from the connectors.
  bool occluder_wanders = false;
  /// Every so many frames only the upper half of the rows is fresh; 0: never.
  int stale_half_every = 0;
  bool write_abcy16 = false;
};

/// Reads and checks a scenario file. The seed decides random poses. Throws host::InputError naming file, line and key.
TofScenario read_tof_scenario(const std::filesystem::path& path, std::uint64_t seed);

}  // namespace pharos::sim
