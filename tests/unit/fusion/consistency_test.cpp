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

}  // namespace
}  // namespace pharos
