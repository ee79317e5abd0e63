// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/sim/approach/approach_simulator.hpp"
#include "tools/sim/tof/tof_poses.hpp"

namespace pharos::sim {

/// All clocks of raw data start here: images are named by their time in ns, which has 16 digits from 1e6 s on.
inline constexpr double kRawStart_s = 1e6;

/// An image or a pair of one source: its name (the source's clock, ns) and T_sensor_ring.
struct RawFrame {
  std::string name;
  CameraFromTarget T_sensor_ring;
  Vector3 to_sun_ring = Vector3::UnitZ();  // unit, in the ring's frame
};

/// The images of a source that sees the target, in order. T_target_ring: where the docking ring is on the target.
std::vector<RawFrame> raw_frames(const ApproachSimulator& simulator, std::size_t source,
                                 const host::TargetFromFeature& T_target_ring);

/// The docking ring's frame on the target: that of the source tof, else of ring2, else of a usual tof.
host::TargetFromFeature docking_ring(const ApproachScenario& scenario);

/// Where the lighthouse's target is on the docking ring's frame.
Pose<frame::Target, frame::Body> lighthouse_target(const ApproachScenario& scenario);

/// What is written of one source, and who is told of each image.
struct RawOutput {
  const ApproachSimulator& simulator;
  std::size_t source = 0;
  std::uint64_t seed = 1;
  std::filesystem::path folder;
  std::string target_file;  // sensors of the lighthouse's target
  std::function<void()> written;
};

/// edges.csv.gz, target.csv, stations.toml and more of `pharos sim lighthouse`, errors `workshop`; target_surveyed.csv:
/// the true sensors in the feature's frame, which is the frame that the nominal ones define by least squares.
void write_raw_lighthouse(const RawOutput& output);
/// NAME_intensity.png, NAME_depth.png, camera.toml.
void write_raw_tof(const RawOutput& output);
/// NAME_left.png, NAME_right.png, rig.toml. The sensor frame is the rig's.
void write_raw_ring2(const RawOutput& output);
/// left/NAME.png, right/NAME.png, rig.toml. The sensor frame is the left camera's.
void write_raw_slam(const RawOutput& output);

}  // namespace pharos::sim
