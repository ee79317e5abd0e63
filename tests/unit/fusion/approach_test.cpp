// SPDX-License-Identifier: Apache-2.0
// Whole approaches fused as a user does it, beside the truth of a simulator that knows nothing of the filter.
#include <gtest/gtest.h>

#include "tests/unit/fusion/approach_run.hpp"

namespace pharos::tests {
namespace {

constexpr double kFiveSigmas = 35.0;  // chi-squared of three: 1e-7

sim::ApproachScenario scenario(const std::string& name) {
  return sim::read_approach_scenario(std::string(PHAROS_SCENARIOS) + "/approach_" + name + ".toml");
}

// Eight faults, some at the same time. Seeds in which a conflict ended in a wrong state, or a wrong time was followed.
TEST(FusedApproach, FaultsOneAfterTheOtherLeaveNoWrongStateThatIsToldAsSound) {
  for (const std::uint64_t seed : {4u, 7u, 8u, 10u}) {
    std::size_t sound = 0;
    fuse_approach(sim::ApproachSimulator(scenario("faults"), seed), {}, [&](const ApproachLook& at) {
      if (!at.told_as_sound()) return;
      ++sound;
      EXPECT_LT(std::max(at.rotation_chi2, at.position_chi2), kFiveSigmas) << "seed " << seed << " at " << at.time_s;
    });
    EXPECT_GT(sound, 3000u) << seed;  // of 3,790
  }
}

TEST(FusedApproach, StatesTheErrorsThatItHasWhereTheMountingStatesTheSlowOnes) {
  double nees = 0.0;
  std::size_t looks = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    fuse_approach(sim::ApproachSimulator(scenario("nominal"), seed), {}, [&](const ApproachLook& at) {
      nees += at.nees;
      ++looks;
    });
  }
  // Slow errors are few draws an approach.
  EXPECT_GT(nees / static_cast<double>(looks), 0.6);
  EXPECT_LT(nees / static_cast<double>(looks), 1.3);
}

}  // namespace
}  // namespace pharos::tests
