// SPDX-License-Identifier: Apache-2.0
#include "tools/precision/noise_estimate.hpp"

#include <gtest/gtest.h>

#include <memory>

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
        EXPECT_FALSE(noise.moving());
        // 2,400 turns: a sigma to 1.5 %, a correlation to 0.02, both once each.
        EXPECT_NEAR(noise.sigma_rad / kPaperSigma_rad, 1.0, 0.06);
        ASSERT_TRUE(noise.rho.has_value());
        EXPECT_NEAR(*noise.rho, rho, 0.08);
      }
    }
  }
}

TEST(NoiseEstimate, ATargetInMotionIsCalledThat) {
  sim::LighthouseScenario scenario = paper_scenario(kDuration_s);
  scenario.trajectory = sim::make_random_manoeuvre({}, kDuration_s, sim::RandomStream(5, "motion"));
  for (const RotorNoise& noise : noise_of(SimulatedRun(std::move(scenario), 5))) EXPECT_TRUE(noise.moving());
}

TEST(NoiseEstimate, AShortRecordingHasNone) {
  NoiseEstimator estimator;
  const SimulatedRun run = at_rest(0.5, 6);
  for (std::size_t i = 0; i < run.sweeps().size() / 10; ++i) estimator.push(run.sweeps()[i]);
  EXPECT_TRUE(estimator.estimate().empty());
}

}  // namespace
}  // namespace pharos::tools
