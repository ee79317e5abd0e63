// SPDX-License-Identifier: Apache-2.0
// Stages of a station's parameters: unknown, OOTX, calibrated. In each of them errors are as large as stated. (The
// third stage: motion_accuracy_test.cpp.)
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/unit/motion/flight.hpp"

namespace pharos::motion {
namespace {

// Stations as real ones are, with what their factory's calibration leaves, and a target built from its drawing.
test::FlightScore score_of(int flights, const test::Prepare& prepare, const char* name) {
  constexpr double kDuration_s = 2.0, kSettled_s = 1.5;  // the counter starts at one second
  test::FlightScore score;
  for (int seed = 1; seed <= flights; ++seed) {
    sim::LighthouseScenario scenario = test::manoeuvre(kDuration_s, 0.5, 60.0, static_cast<std::uint64_t>(seed));
    scenario.errors = sim::ErrorScenario::workshop();
    scenario.stations.front().calibration.reset();  // drawn: tools/sim
    MotionOptions options = test::flight_options();
    options.systematic = kUncalibratedErrors;
    test::fly(
        scenario, static_cast<std::uint64_t>(seed),
        [&](const test::FlightSample& answer) {
          if (answer.time_s > kSettled_s) score.add(answer);
        },
        [](lighthouse::Sweep&) {}, options, prepare);
  }
  std::printf(
      "%s: NEES %.2f (rotation %.2f, position %.2f), RMS %.2f deg %.1f mm, stated %.1f mm, %d answers, %d refused\n",
      name, score.nees_per_freedom(), score.rotation_nees / (3.0 * score.answers),
      score.position_nees / (3.0 * score.answers), score.rotation_rms_deg(), score.position_rms_mm(),
      std::sqrt(score.sigma_position_square / score.answers) * kMmPerM, score.answers, score.refused);
  return score;
}

constexpr int kFlights = 60;

TEST(StationStages, AStationOfUnknownCalibrationIsAsFarOffAsStated) {
  const test::FlightScore score = score_of(
      kFlights, [](MotionTracker&, const sim::LighthouseSimulator&) {}, "no calibration");
  EXPECT_GT(score.position_rms_mm(), 30.0);  // an ideal station it is not
  EXPECT_GT(score.nees_per_freedom(), 0.8);
  EXPECT_LT(score.nees_per_freedom(), 1.3);
}

TEST(StationStages, WhatAStationSendsOfItselfIsAsFarOffAsStated) {
  const test::FlightScore score = score_of(kFlights, test::tell_announced, "OOTX");
  EXPECT_GT(score.nees_per_freedom(), 0.8);
  EXPECT_LT(score.nees_per_freedom(), 1.3);
}

}  // namespace
}  // namespace pharos::motion
