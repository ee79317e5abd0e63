// SPDX-License-Identifier: Apache-2.0
#include "tools/precision/noise_estimate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"

namespace pharos::tools {
namespace {

constexpr double kDuration_s = 40.0;

SimulatedRun at_rest(double rho, std::uint64_t seed) {
  sim::LighthouseScenario scenario = paper_scenario(kDuration_s);
  scenario.noise.rho = rho;
  sim::RandomStationaryPoses pose;
  pose.count = 1;
  pose.min_range_m = 1.5;
  pose.max_range_m = 2.5;
  pose.min_lit = 6;
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(
      sim::random_stationary_poses(pose, scenario.target, 60.0, sim::RandomStream(seed, "rest")), 2.0 * kDuration_s,
      0.0);
  return {std::move(scenario), seed};
}

std::vector<RotorNoise> noise_of(const SimulatedRun& run) {
  NoiseEstimator estimator;
  for (const lighthouse::Sweep& sweep : run.sweeps()) estimator.push(sweep);
  return estimator.estimate();
}

TEST(NoiseEstimate, FindsTheSimulatorsSigmaAndCorrelation) {
  for (const double rho : {0.0, 0.5, kPaperRho}) {
    for (const std::uint64_t seed : {3U, 4U}) {
      const auto rotors = noise_of(at_rest(rho, seed));
      ASSERT_EQ(rotors.size(), 2U);
      for (const RotorNoise& noise : rotors) {
        EXPECT_GE(noise.sensors, 4);
        EXPECT_EQ(noise.verdict(), NoiseVerdict::kOk);
        EXPECT_EQ(noise.left_out, 0);
        // 2,400 turns: a sigma to 1.5 %, a correlation to 0.02, both once each.
        EXPECT_NEAR(noise.sigma_rad / kPaperSigma_rad, 1.0, 0.06);
        ASSERT_TRUE(noise.rho.has_value());
        EXPECT_NEAR(*noise.rho, rho, 0.08);
      }
    }
  }
}

// Hits of the rotor along x are put off at random where `suspect` says so, as by a reflection.
std::vector<RotorNoise> noise_with(const SimulatedRun& run, const std::function<bool(std::uint8_t)>& suspect) {
  constexpr int kOff_half_ticks = 300;  // uniform: 1.7 us RMS of a turn of 16.7 ms, 134 arcsec
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int32_t> off(-kOff_half_ticks, kOff_half_ticks);
  NoiseEstimator estimator;
  for (lighthouse::Sweep sweep : run.sweeps()) {
    for (lighthouse::Hit& hit : sweep.hits) {
      if (sweep.flash.axis == Axis::kX && suspect(hit.sensor)) hit.centre_half_ticks += off(random);
    }
    estimator.push(sweep);
  }
  return estimator.estimate();
}

std::set<std::uint8_t> sensors_of(const SimulatedRun& run) {
  std::set<std::uint8_t> sensors;
  for (const lighthouse::Sweep& sweep : run.sweeps()) {
    if (sweep.flash.axis != Axis::kX) continue;
    for (const lighthouse::Hit& hit : sweep.hits) sensors.insert(hit.sensor);
  }
  return sensors;
}

TEST(NoiseEstimate, ASensorMuchNoisierThanItsPeersIsLeftOut) {
  const SimulatedRun run = at_rest(0.5, 8);
  const std::uint8_t bad = *sensors_of(run).begin();
  const auto rotors = noise_with(run, [bad](std::uint8_t sensor) { return sensor == bad; });
  ASSERT_EQ(rotors.size(), 2U);
  for (const RotorNoise& noise : rotors) {
    EXPECT_EQ(noise.left_out, noise.axis == Axis::kX ? 1 : 0);
    EXPECT_EQ(noise.verdict(), NoiseVerdict::kOk);
    EXPECT_NEAR(noise.sigma_rad / kPaperSigma_rad, 1.0, 0.06);
    EXPECT_NEAR(noise.rho.value_or(-1.0), 0.5, 0.08);
  }
}

// Of two sensors one is put off: nothing tells which is right.
TEST(NoiseEstimate, TwoSensorsThatDisagreeAreNoAnswer) {
  const SimulatedRun run = at_rest(0.5, 8);
  const std::uint8_t good = *sensors_of(run).begin(), other = *std::next(sensors_of(run).begin());
  NoiseEstimator estimator;
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int32_t> off(-300, 300);
  for (lighthouse::Sweep sweep : run.sweeps()) {
    lighthouse::Sweep two = sweep;
    two.hits.clear();
    for (lighthouse::Hit hit : sweep.hits) {
      if (hit.sensor == other) hit.centre_half_ticks += off(random);
      if (hit.sensor == good || hit.sensor == other) two.hits.push_back(hit);
    }
    estimator.push(two);
  }
  const auto rotors = estimator.estimate();
  ASSERT_EQ(rotors.size(), 2U);
  for (const RotorNoise& noise : rotors) EXPECT_EQ(noise.verdict(), NoiseVerdict::kDisagree);
}

TEST(NoiseEstimate, ATargetInMotionIsCalledThat) {
  sim::LighthouseScenario scenario = paper_scenario(kDuration_s);
  scenario.trajectory = sim::make_random_manoeuvre({}, kDuration_s, sim::RandomStream(5, "motion"));
  for (const RotorNoise& noise : noise_of(SimulatedRun(std::move(scenario), 5))) {
    EXPECT_EQ(noise.verdict(), NoiseVerdict::kMoving);
  }
}

TEST(NoiseEstimate, AShortRecordingHasNone) {
  NoiseEstimator estimator;
  const SimulatedRun run = at_rest(0.5, 6);
  for (std::size_t i = 0; i < run.sweeps().size() / 10; ++i) estimator.push(run.sweeps()[i]);
  EXPECT_TRUE(estimator.estimate().empty());
}

}  // namespace
}  // namespace pharos::tools
