// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/pnp_campaign.hpp"
#include "tests/unit/pose/exhaustive_minima.hpp"

namespace pharos::pose {
namespace {

constexpr int kProblems = 200000;

SolveOptions options_with(double sigma_rad) {
  SolveOptions options;
  options.sigma_rad = sigma_rad;
  return options;
}

TEST(LongCampaign, TargetClass) {
  for (const double arcsec : {8.8, 60.0}) {
    test::PnpSet set;
    set.sigma_rad = arcsec * kRadPerArcsec;
    test::print("coplanar views too",
                test::run_campaign(test::frustum_target(), set, options_with(set.sigma_rad), kProblems, 11));
    set.coplanar_views = false;
    const auto result = test::run_campaign(test::frustum_target(), set, options_with(set.sigma_rad), kProblems, 11);
    test::print(arcsec < 10.0 ? "8.8 arcsec" : "60 arcsec", result);
    EXPECT_LE(result.score.refused, kProblems / 100000);  // iterations that end in a flat valley
    EXPECT_LE(result.score.rotation_over_bound(), 1.02);
    EXPECT_LE(result.score.position_over_bound(), 1.02);
    EXPECT_EQ(result.failures_that_truth_fits_better, 0);
    EXPECT_GT(result.nees_per_freedom, 0.95);
    EXPECT_LT(result.nees_per_freedom, 1.05);
  }
}

TEST(LongCampaign, FourCoplanar) {
  test::PnpSet set;
  set.max_sensors = 4;
  const auto result = test::run_campaign(test::top_plate_target(), set, options_with(set.sigma_rad), kProblems, 12);
  test::print("four coplanar, 8.8 arcsec", result);
  EXPECT_EQ(result.failures_that_truth_fits_better, 0);
  EXPECT_LE(result.score.failures, kProblems * 75 / 1000);
  EXPECT_LE(result.score.wrong_unflagged, kProblems / 1000);
}

TEST(LongCampaign, ExhaustiveSearch) {
  for (const double arcsec : {8.8, 60.0}) {
    for (const bool coplanar : {false, true}) {
      test::PnpSet set;
      set.sigma_rad = arcsec * kRadPerArcsec;
      const MinimaScore score =
          compare_minima(coplanar ? test::top_plate_target() : test::frustum_target(), set, 3000, 13);
      std::printf("%4.1f arcsec %s: problems %d ambiguous %d better missed %d second missed %d second false %d\n",
                  arcsec, coplanar ? "coplanar" : "all", score.problems, score.ambiguous, score.better_missed,
                  score.second_missed, score.second_false);
      EXPECT_EQ(score.better_missed, 0);
      EXPECT_LE(score.second_missed, score.problems / 1000);
      EXPECT_LE(score.second_false, score.problems / 1000);
    }
  }
}

}  // namespace
}  // namespace pharos::pose
