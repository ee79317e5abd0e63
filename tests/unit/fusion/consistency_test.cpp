// SPDX-License-Identifier: Apache-2.0
// The stated covariance beside the truth of worlds that know nothing of the filter.
#include <gtest/gtest.h>

#include "tools/evaluation/reproduce/fusion/fusion_run.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_scenario.hpp"

namespace pharos {
namespace {

// Slow errors last longer than a run: of 12 runs the NEES scatters by 0.1. `pharos reproduce fusion` has 100.
TEST(FusionConsistency, StatesTheErrorsThatItHas) {
  double pose = 0.0, rates = 0.0;
  std::size_t looks = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    sim::WorldSettings world = tools::close_range_world(seed);
    world.duration_s = 15.0;
    for (sim::MeasuredSource& source : world.sources) source.delay_s = 0.001;
    const tools::RunFigures figures = tools::run_fusion(world, tools::settings_of(world, 1e-3));
    pose += figures.pose_nees;
    rates += figures.rate_nees;
    looks += figures.settled;
    EXPECT_EQ(figures.outside, 0u) << "seed " << seed;
    EXPECT_EQ(figures.wrong_excluded, 0u) << "seed " << seed;
    EXPECT_EQ(figures.answered, figures.looks) << "seed " << seed;
    EXPECT_LE(figures.counters.largest_hand_over_sigma, 1.0) << "seed " << seed;
  }
  EXPECT_GT(pose / (6.0 * static_cast<double>(looks)), 0.7);
  EXPECT_LT(pose / (6.0 * static_cast<double>(looks)), 1.3);
  EXPECT_GT(rates / (6.0 * static_cast<double>(looks)), 0.8);
  EXPECT_LT(rates / (6.0 * static_cast<double>(looks)), 1.2);
}

// The lighthouse's poses are those of a filter: their noise is alike for a fifth of a second, of 12 poses.
struct Errors {
  double nees = 0.0, position_m2 = 0.0;
};

Errors errors_beside_a_filtering_source(double stated_noise_time_s) {
  Errors out;
  std::size_t looks = 0;
  for (std::uint64_t seed = 21; seed <= 26; ++seed) {
    sim::WorldSettings world = tools::close_range_world(seed);
    world.duration_s = 15.0;
    world.sources[0].noise_time_s = 0.2;
    for (sim::MeasuredSource& source : world.sources) source.delay_s = 0.001;
    fusion::Settings settings = tools::settings_of(world, 1e-3);
    settings.sources[0].noise_time_s = stated_noise_time_s;
    const tools::RunFigures figures = tools::run_fusion(world, settings);
    out.nees += figures.pose_nees / 6.0;
    out.position_m2 += figures.position_m2;
    looks += figures.settled;
    EXPECT_EQ(figures.wrong_excluded, 0u) << "seed " << seed;
  }
  out.nees /= static_cast<double>(looks);
  return out;
}

TEST(FusionConsistency, ASourceThatFiltersTellsLittleNewWithEachPose) {
  const Errors stated = errors_beside_a_filtering_source(0.2);
  const Errors as_white = errors_beside_a_filtering_source(0.0);
  EXPECT_GT(stated.nees, 0.7);
  EXPECT_LT(stated.nees, 1.3);
  EXPECT_GT(as_white.nees, 1.5 * stated.nees);
  EXPECT_LT(stated.position_m2, as_white.position_m2);
}

}  // namespace
}  // namespace pharos
