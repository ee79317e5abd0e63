// SPDX-License-Identifier: Apache-2.0
// usage: host_tof_frame FILE: writes a simulated frame for the target's program and prints the host's results.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "tests/target/tof/frame_file.hpp"
#include "tests/target/tof/frame_result.hpp"
#include "tools/sim/tof/tof_simulator.hpp"

namespace {

// The third of paper 000's poses: a ring of 1.1 m at 3.16 m.
std::unique_ptr<pharos::test::FrameFile> simulated() {
  using namespace pharos;  // NOLINT: a program of one page
  sim::TofScenario scenario;
  sim::CameraFromTarget pose;
  pose.t = Vector3(-0.0249, -0.0177, 3.161);
  pose.R = sim::attitude_of({2.2, -1.1, -50.0});
  scenario.poses = {pose};
  const sim::TofPixels pixels = sim::TofSimulator(scenario, 1).pixels(0);
  auto file = std::make_unique<test::FrameFile>();
  file->fx_px = scenario.lens.fx_px;
  file->fy_px = scenario.lens.fy_px;
  file->cx_px = scenario.lens.cx_px;
  file->cy_px = scenario.lens.cy_px;
  file->distortion = scenario.lens.distortion;
  file->depth_scale_m = scenario.depth.scale_m;
  file->depth_origin_z_m = scenario.depth.origin_z_m;
  std::copy(pixels.intensity.begin(), pixels.intensity.end(), file->intensity.begin());
  std::copy(pixels.depth.begin(), pixels.depth.end(), file->depth.begin());
  return file;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const auto file = simulated();
  std::FILE* out = std::fopen(words[1], "wb");
  if (out == nullptr || std::fwrite(file.get(), sizeof(*file), 1, out) != 1 || std::fclose(out) != 0) return 1;
  const auto workspace = std::make_unique<pharos::tof::TofWorkspace>();
  pharos::test::print_result(pharos::tof::measure_tof_pose(file->frame(), file->camera(), {}, *workspace), *workspace);
}
