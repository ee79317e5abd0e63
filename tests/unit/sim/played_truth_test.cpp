// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tools/sim/playback_input.hpp"

namespace pharos::sim {
namespace {

// By least squares: what is left of the sensors' errors neither shifts nor turns the body.
TEST(PlayedTruth, IsInTheBodyFrameOfTheNominalSensorPositions) {
  const PlaybackInput input = open_playback_input(PHAROS_SCENARIOS "/demo.toml", 1);
  const LighthouseSimulator& simulator = *input.simulator;
  const LighthouseFromBody truth = truth_of(input, "").at(0, 1.0);
  const LighthouseFromBody built = simulator.truth(0, simulator.clock().counter_time(1.0));
  EXPECT_GT((truth.R - built.R).norm(), 1e-3) << "the scene has errors";
  Vector3 shift = Vector3::Zero(), turn = Vector3::Zero();
  Vector3 centre = Vector3::Zero();
  const Target& nominal = simulator.nominal_target();
  for (const SensorPlacement& sensor : nominal) centre += sensor.position_m / static_cast<double>(nominal.size());
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    const Vector3 error = built * simulator.true_target()[i].position_m - truth * nominal[i].position_m;
    shift += error;
    turn += (truth.R * (nominal[i].position_m - centre)).cross(error);
  }
  EXPECT_LT(shift.norm(), 1e-12);
  EXPECT_LT(turn.norm(), 1e-12);
}

}  // namespace
}  // namespace pharos::sim
