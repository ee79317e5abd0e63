// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/pnp_campaign.hpp"
#include "tests/unit/pose/exhaustive_minima.hpp"

namespace pharos::pose {
namespace {

constexpr double kRoughSigma_rad = 60.0 * kRadPerArcsec;

test::PnpSet set_of(double sigma_rad, double rho = 0.0) {
  test::PnpSet set;
  set.sigma_rad = sigma_rad;
  set.rho = rho;
  return set;
}

SolveOptions options_for(const test::PnpSet& set) {
  SolveOptions options;
  options.sigma_rad = set.sigma_rad;
  options.rho = set.rho;
  return options;
}

TEST(Campaign, ReachesTheCramerRaoBoundAtThePapersNoise) {
  test::PnpSet set = set_of(kPaperSigma_rad);
  set.coplanar_views = false;
  const auto result = test::run_campaign(test::frustum_target(), set, options_for(set), 2000, 1);
  test::print("8.8 arcsec", result);
  EXPECT_EQ(result.score.refused, 0);
  EXPECT_LE(result.score.rotation_over_bound(), 1.02);
  EXPECT_LE(result.score.position_over_bound(), 1.02);
  EXPECT_EQ(result.score.wrong_unflagged, 0);
  EXPECT_EQ(result.failures_that_truth_fits_better, 0);
  EXPECT_EQ(result.score.failures, 0);
}

TEST(Campaign, NoFailureAtSixtyArcsecIsAMissedMinimum) {
  test::PnpSet set = set_of(kRoughSigma_rad);
  const auto everything = test::run_campaign(test::frustum_target(), set, options_for(set), 2000, 2);
  test::print("60 arcsec, coplanar views too", everything);
  EXPECT_EQ(everything.failures_that_truth_fits_better, 0);
  set.coplanar_views = false;
  const auto result = test::run_campaign(test::frustum_target(), set, options_for(set), 2000, 2);
  test::print("60 arcsec", result);
  EXPECT_EQ(result.score.refused, 0);
  EXPECT_LE(result.score.rotation_over_bound(), 1.02);
  EXPECT_LE(result.score.position_over_bound(), 1.02);
  EXPECT_EQ(result.failures_that_truth_fits_better, 0);
}

TEST(Campaign, CoplanarSensorsAreWrongOnlyWhereTheWrongPoseFitsBetterAndThenSaySo) {
  test::PnpSet set = set_of(kPaperSigma_rad);
  set.max_sensors = 4;
  const auto result = test::run_campaign(test::top_plate_target(), set, options_for(set), 4000, 3);
  test::print("four coplanar, 8.8 arcsec", result);
  EXPECT_EQ(result.score.refused, 0);
  EXPECT_EQ(result.failures_that_truth_fits_better, 0);
  EXPECT_LE(result.score.wrong_unflagged, result.score.problems / 1000);
}

TEST(Campaign, CovarianceIsConsistent) {
  for (const double rho : {0.0, kPaperRho}) {
    const test::PnpSet set = set_of(kPaperSigma_rad, rho);
    const auto result = test::run_campaign(test::frustum_target(), set, options_for(set), 10000, 4);
    test::print(rho == 0.0 ? "NEES, rho 0" : "NEES, rho 0.8717", result);
    EXPECT_GT(result.nees_per_freedom, 0.95);
    EXPECT_LT(result.nees_per_freedom, 1.05);
  }
}

// Reported, not asserted: consistency of the covariance when the noise is not as assumed.
TEST(Campaign, ReportsNeesUnderOtherNoiseThanAssumed) {
  const Target target = test::frustum_target();
  const test::PnpSet set = set_of(10.8 * kRadPerArcsec, 0.97);
  test::PnpGenerator generator(target, set, 5);
  for (const double assumed_rho : {0.0, kPaperRho}) {
    SolveOptions options;
    options.rho = assumed_rho;
    std::vector<double> nees;
    for (int k = 0; k < 2000; ++k) {
      test::PnpProblem problem = generator.next();
      Observation reflection = problem.observations[0];
      reflection.theta_rad += 866 * 20e-9 * 60.0 * kTwoPi;  // the recorded one: 866 ticks late
      problem.observations.push_back(reflection);
      const auto solution = solve(target, problem.observations, options);
      if (solution.ok() && !solution->estimate.ambiguous()) {
        nees.push_back(test::nees_of(problem.truth, solution->estimate) / 6.0);
      }
    }
    ASSERT_FALSE(nees.empty());
    double mean = 0.0;
    for (const double v : nees) mean += v / static_cast<double>(nees.size());
    std::nth_element(nees.begin(), nees.begin() + static_cast<std::ptrdiff_t>(nees.size() / 2), nees.end());
    std::printf("rho 0.97, 10.8 arcsec, one reflection; told 8.8 and rho %.4f: NEES/dof mean %.2f median %.2f\n",
                assumed_rho, mean, nees[nees.size() / 2]);
  }
}

// The paper's figure 5: stationary sets, predicted (24) and measured (23).
TEST(Campaign, PredictedSigmaOfStaticSetsIsTheMeasuredOne) {
  constexpr int kSets = 50, kFrames = 3600;
  const Target target = test::frustum_target();
  const test::PnpSet set = set_of(kPaperSigma_rad, kPaperRho);
  test::PnpGenerator generator(target, set, 6);
  std::vector<double> rotation_ratio, position_ratio;
  while (rotation_ratio.size() < kSets) {
    test::PnpProblem problem = generator.next();
    const auto precision = precision_of(target, problem.truth, problem.seen, set.rho);
    ASSERT_TRUE(precision.ok());
    double rotation = 0.0, position = 0.0;
    int frames = 0;
    for (int k = 0; k < kFrames; ++k) {
      generator.observe(problem);
      const auto solution = solve(target, problem.observations, options_for(set));
      ASSERT_TRUE(solution.ok());
      if (solution->estimate.ambiguous()) continue;
      const Vector6 error = pose_difference(solution->estimate.pose, problem.truth);
      rotation += error.head<3>().squaredNorm();
      position += error.tail<3>().squaredNorm();
      ++frames;
    }
    if (frames < kFrames / 2) continue;  // a view perpendicular to a plane
    rotation_ratio.push_back(std::sqrt(rotation / frames) * kDegPerRad / (precision->adop_deg_per_rad * set.sigma_rad));
    position_ratio.push_back(std::sqrt(position / frames) / (precision->pdop_m_per_rad * set.sigma_rad));
  }
  std::sort(rotation_ratio.begin(), rotation_ratio.end());
  std::sort(position_ratio.begin(), position_ratio.end());
  std::printf(
      "measured over predicted, %d still sets of %d: rotation median %.3f (%.3f-%.3f) position %.3f (%.3f-%.3f)\n",
      kSets, kFrames, rotation_ratio[kSets / 2], rotation_ratio.front(), rotation_ratio.back(),
      position_ratio[kSets / 2], position_ratio.front(), position_ratio.back());
  EXPECT_NEAR(rotation_ratio[kSets / 2], 1.0, 0.1);
  EXPECT_NEAR(position_ratio[kSets / 2], 1.0, 0.1);
}

TEST(Campaign, FindsTheMinimaThatAnExhaustiveSearchFinds) {
  test::PnpSet rough = set_of(kRoughSigma_rad);
  rough.max_sensors = 4;
  for (const auto& [target, set] :
       {std::pair{test::frustum_target(), set_of(kPaperSigma_rad)}, std::pair{test::frustum_target(), rough},
        std::pair{test::top_plate_target(), rough}}) {
    const MinimaScore score = compare_minima(target, set, 300, 7);
    std::printf("exhaustive: problems %d ambiguous %d better missed %d second missed %d second false %d\n",
                score.problems, score.ambiguous, score.better_missed, score.second_missed, score.second_false);
    EXPECT_EQ(score.better_missed, 0);
    EXPECT_EQ(score.second_missed, 0);
    EXPECT_LE(score.second_false, 1);  // the exhaustive search is not perfect either
  }
}

}  // namespace
}  // namespace pharos::pose
