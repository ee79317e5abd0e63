// SPDX-License-Identifier: Apache-2.0
// Statistics over approaches: faults, random ones, none.
#include <gtest/gtest.h>

#include "tests/unit/fusion/approach_run.hpp"

namespace pharos::tests {
namespace {

TEST(FusedApproachCampaign, FaultsOneAfterTheOther) {
  std::size_t sound = 0, beyond = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    fuse_approach(sim::ApproachSimulator(approach_scenario("faults"), seed), {}, [&](const ApproachLook& at) {
      EXPECT_FALSE(at.outside_level()) << "seed " << seed << " at " << at.time_s;
      EXPECT_FALSE(at.told_as_sound() && at.far_off()) << "seed " << seed << " at " << at.time_s;
      sound += at.told_as_sound() ? 1U : 0U;
      beyond += at.told_as_sound() && at.beyond_five_sigmas() ? 1U : 0U;
    });
  }
  EXPECT_LT(beyond, sound / 1000);
}

// From when two absolute sources see the target: what one alone says at the very start is believed.
TEST(FusedApproachCampaign, EightRandomFaults) {
  for (std::uint64_t seed = 101; seed <= 140; ++seed) {
    fuse_approach(sim::ApproachSimulator(with_random_faults(seed, 125.0), seed), {}, [&](const ApproachLook& at) {
      EXPECT_FALSE(at.outside_level()) << "seed " << seed << " at " << at.time_s;
      EXPECT_FALSE(at.told_as_sound() && at.far_off()) << "seed " << seed << " at " << at.time_s;
    });
  }
}

TEST(FusedApproachCampaign, RightSourcesAreBelievedAndErrorsAreStated) {
  for (const char* name : {"nominal", "tumbling", "no_lighthouse", "sun_in_camera"}) {
    double nees = 0.0;
    std::size_t looks = 0, excluded = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      fuse_approach(sim::ApproachSimulator(approach_scenario(name), seed), {}, [&](const ApproachLook& at) {
        nees += at.nees;
        ++looks;
        for (std::size_t s = 0; s < at.state.sources.size(); ++s) excluded += at.excludes(s) ? 1U : 0U;
      });
    }
    // Slow errors are few draws an approach.
    EXPECT_GT(nees / static_cast<double>(looks), 0.6) << name;
    EXPECT_LT(nees / static_cast<double>(looks), 1.3) << name;
    EXPECT_LE(excluded, looks / 1000) << name;
  }
}

}  // namespace
}  // namespace pharos::tests
