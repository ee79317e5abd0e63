// SPDX-License-Identifier: Apache-2.0
// A satellite without a docking ring has no pose, whatever circles it shows.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "pharos/tof/tof_pose.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"

namespace pharos::tools {
namespace {

sim::TofScenario without_ring(bool painted) {
  sim::TofScenario scenario;
  scenario.satellite.ring.reset();
  // Circles on the foil where the ring would be.
  if (painted) scenario.satellite.circles = {{0.0, 0.0, 0.55, 0.06, 0.5}};
  for (const auto& [z, alpha] : {std::pair{3.0, 0.0}, std::pair{2.5, 20.0}, std::pair{4.0, -30.0}}) {
    scenario.poses.push_back({sim::attitude_of({alpha, 5.0, 40.0}), Vector3(0.05, -0.04, z)});
  }
  return scenario;
}

class NozzleAlone : public testing::TestWithParam<bool> {};

TEST_P(NozzleAlone, GivesNoPose) {
  const sim::TofScenario scenario = without_ring(GetParam());
  sim::TofSimulator simulator(scenario, 1);
  const DepthCamera camera = depth_camera_of(scenario);
  const auto workspace = std::make_unique<tof::TofWorkspace>();
  for (int k = 0; k < simulator.frames(); ++k) {
    const sim::TofPixels pixels = simulator.pixels(k);
    EXPECT_FALSE(tof::measure_tof_pose(frame_of(pixels), camera, tof::TofSettings{}, *workspace).ok()) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(CirclesOnTheFoil, NozzleAlone, testing::Bool());

}  // namespace
}  // namespace pharos::tools
