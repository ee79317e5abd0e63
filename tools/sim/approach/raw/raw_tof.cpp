// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/raw/approach_body.hpp"
#include "tools/sim/approach/raw/raw_source.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/tof/tof_writer.hpp"

namespace pharos::sim {

void write_raw_tof(const RawOutput& output) {
  const host::TargetFromFeature T_target_ring = docking_ring(output.simulator.scenario());
  const std::vector<RawFrame> frames = raw_frames(output.simulator, output.source, T_target_ring);
  TofScenario scenario;
  scenario.satellite = approach_satellite(lighthouse_target(output.simulator.scenario()));
  for (const RawFrame& frame : frames) scenario.poses.push_back(frame.T_sensor_ring);
  make_output_folder(output.folder);
  write_tof_camera(scenario, output.folder);
  TofSimulator simulator(std::move(scenario), output.seed);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    write_tof_frame(simulator, static_cast<int>(i), frames[i].name, output.folder);
    output.written();
  }
}

}  // namespace pharos::sim
