// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/calibrate/lighthouse_calibration.hpp"
#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "unit/host/calibrate/simulated_session.hpp"

namespace pharos::calibrate::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

LighthouseCalibrationInput sound(int poses = 8) {
  Session session;
  session.poses = poses;
  session.rest_s = 1.0;
  sim::LighthouseSimulator simulator(scenario_of(session), session.seed);
  return calibration_input(simulator, session.seed);
}

std::string refusal_of(const LighthouseCalibrationInput& material) {
  return pharos::test::error_of([&] { calibrate_lighthouse(material); });
}

TEST(CalibrationRefusals, ATargetThatNeverMoved) { EXPECT_THAT(refusal_of(sound(1)), HasSubstr("never moved")); }

TEST(CalibrationRefusals, ATargetThatWasNeverStationary) {
  Session session;
  sim::LighthouseScenario scenario = scenario_of(session);
  scenario.duration_s = 5.0;
  scenario.trajectory = sim::make_random_manoeuvre({}, scenario.duration_s, sim::RandomStream(1, "flight"));
  sim::LighthouseSimulator simulator(scenario, 1);
  EXPECT_THAT(refusal_of(calibration_input(simulator, 1)), AllOf(HasSubstr("simulated"), HasSubstr("never rested")));
}

TEST(CalibrationRefusals, TooFewPoses) {
  EXPECT_THAT(refusal_of(sound(4)), AllOf(HasSubstr("too few poses: 4"), HasSubstr("6")));
}

TEST(CalibrationRefusals, ARecordingWithoutLight) {
  LighthouseCalibrationInput material = sound(1);
  material.recordings.front().sweeps.clear();
  EXPECT_THAT(refusal_of(material), HasSubstr("no sweep"));
}

TEST(CalibrationRefusals, AnotherTargetsSensors) {
  LighthouseCalibrationInput material = sound();
  material.lengths.clear();
  for (SensorPlacement& sensor : material.target) sensor.sensor = static_cast<std::uint8_t>(sensor.sensor + 16);
  EXPECT_THAT(refusal_of(material), HasSubstr("--target"));
}

// A table with one sensor where another body has it: the recordings are enough to bend it to the body that was there.
TEST(CalibrationRefusals, AnotherBodysTable) {
  LighthouseCalibrationInput material = sound();
  EXPECT_EQ(refusal_of(material), "");
  material.lengths.clear();
  material.target[0].position_m.x() += 0.02;
  EXPECT_THAT(refusal_of(material), AllOf(HasSubstr("not this target"), HasSubstr("mm from where --target has it")));
}

TEST(CalibrationRefusals, AStationThatNobodyKnowsAndTwoThatAreOne) {
  LighthouseCalibrationInput material = sound();
  material.recordings.front().station[1] = material.recordings.front().station[0];
  LoggedSweep other = material.recordings.front().sweeps.back();
  other.slot = 1;
  material.recordings.front().sweeps.push_back(other);
  EXPECT_THAT(refusal_of(material), HasSubstr("same one"));
  material.recordings.front().station[1].reset();
  EXPECT_THAT(refusal_of(material), HasSubstr("identity"));
}

TEST(CalibrationRefusals, AStationThatChangedBetweenRecordings) {
  LighthouseCalibrationInput material = sound();
  material.recordings.push_back(material.recordings.front());
  material.recordings.back().station[0]->rotor[0].phase_rad += 1e-4;
  EXPECT_THAT(refusal_of(material), HasSubstr("other calibration values"));
}

TEST(CalibrationRefusals, LengthsBetweenSensorsThatAreNotThere) {
  LighthouseCalibrationInput material = sound();
  material.lengths.push_back({4, 29, 0.1, 1e-5});
  EXPECT_THAT(refusal_of(material), AllOf(HasSubstr("--length 4,29"), HasSubstr("no sensor 29")));
  material.lengths.back().b = 11;
  for (LoggedSweep& sweep : material.recordings.front().sweeps) {
    std::erase_if(sweep.hits, [](const LoggedHit& hit) { return hit.sensor == 11; });
  }
  EXPECT_THAT(refusal_of(material), HasSubstr("never hit"));
}

TEST(CalibrationRefusals, ALengthThatContradictsTheRest) {
  LighthouseCalibrationInput material = sound();
  material.lengths.front().length_m += 3e-3;
  EXPECT_THAT(refusal_of(material), AllOf(HasSubstr("--length 4,8"), HasSubstr("contradicts")));
  // Two good lengths, then one with an error of ten of its sigmas: only the lengths themselves show it.
  material = sound(12);
  const LighthouseCalibration good = calibrate_lighthouse(material);
  const auto distance = [&](std::size_t a, std::size_t b) {
    return (good.bundle.unknowns.target[a].position_m - good.bundle.unknowns.target[b].position_m).norm();
  };
  material.lengths.push_back({0, 3, distance(0, 3), 2e-5});
  EXPECT_EQ(refusal_of(material), "");
  material.lengths.push_back({1, 2, distance(1, 2) + 4e-4, 2e-5});
  EXPECT_THAT(refusal_of(material), AllOf(HasSubstr("--length 1,2"), HasSubstr("contradicts")));
}

}  // namespace
}  // namespace pharos::calibrate::test
