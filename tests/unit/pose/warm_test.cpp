// SPDX-License-Identifier: Apache-2.0
// The integer solver compared with the one in double, over campaigns: the same results, or none.
#include "pharos/pose/warm.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pharos/geometry/symmetric.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {
namespace {

constexpr double kPriorRotation_rad = 5e-3, kPriorPosition_m = 5e-3;  // 1 sigma an axis: a cycle's motion

LighthouseFromBody disturbed(const LighthouseFromBody& pose, test::PnpGenerator& generator) {
  Vector6 off;
  for (int i = 0; i < 6; ++i) off[i] = (i < 3 ? kPriorRotation_rad : kPriorPosition_m) * generator.normal();
  return pose.moved_by(off);
}

// Views of sensors that are not all in one plane.
test::PnpSet relief() {
  test::PnpSet set;
  set.coplanar_views = false;
  return set;
}

double sigmas_between(const LighthousePoseEstimate& a, const LighthousePoseEstimate& b) {
  const Vector6 d = pose_difference(a.pose, b.pose);
  return std::sqrt(mahalanobis_squared<6>(d, b.covariance));
}

struct Comparison {
  double variance = kPaperSigma_rad * kPaperSigma_rad;
  int problems = 0, unsolved = 0, ambiguous = 0, other_flags = 0;
  double largest_distance_sigma = 0.0, largest_sigma_ratio = 1.0, largest_delta = 0.0, largest_chi2 = 0.0;

  void add(const std::optional<Solution>& warm, const Result<Solution, Refusal>& full) {
    ++problems;
    if (!warm) {
      ++unsolved;
      return;
    }
    ASSERT_TRUE(full.ok()) << "an answer where solve() has none";
    const LighthousePoseEstimate &a = warm->estimate, &b = full->estimate;
    ambiguous += b.ambiguous() ? 1 : 0;
    other_flags += a.ambiguous() != b.ambiguous() ? 1 : 0;
    if (a.ambiguous() && b.ambiguous()) {
      largest_delta = std::max(largest_delta, std::abs(a.second->delta_chi2 - b.second->delta_chi2));
    }
    largest_distance_sigma = std::max(largest_distance_sigma, sigmas_between(a, b));
    for (int i = 0; i < 6; ++i) {
      const double ratio = std::sqrt(a.covariance(i, i) / b.covariance(i, i));
      largest_sigma_ratio = std::max({largest_sigma_ratio, ratio, 1.0 / ratio});
    }
    const double chi2 = (std::pow(a.residual_rms, 2) - std::pow(b.residual_rms, 2)) * b.observations / variance;
    largest_chi2 = std::max(largest_chi2, std::abs(chi2));
    EXPECT_EQ(a.observations, b.observations);
    EXPECT_EQ(warm->used, full->used);
  }
};

Comparison compared(const Target& target, const test::PnpSet& set, int problems, std::uint64_t seed) {
  test::PnpGenerator generator(target, set, seed);
  SolveOptions options;
  options.sigma_rad = set.sigma_rad;
  Comparison comparison;
  comparison.variance = set.sigma_rad * set.sigma_rad;
  for (int k = 0; k < problems; ++k) {
    const test::PnpProblem problem = generator.next();
    const LighthouseFromBody prior = disturbed(problem.truth, generator);
    comparison.add(solve_warm(target, problem.observations, options, prior),
                   solve(target, problem.observations, options, &prior));
  }
  return comparison;
}

// In views perpendicular to a plane the valley between the minima is so flat that either solver may miss a second one.
int flags_that_may_differ(const Comparison& c) { return 1 + c.problems / 5'000; }

void expect_the_same(const Comparison& c) {
  EXPECT_LE(c.other_flags, flags_that_may_differ(c));
  EXPECT_LT(c.largest_distance_sigma, 0.1);
  EXPECT_LT(c.largest_sigma_ratio, 1.05);
  EXPECT_LT(c.largest_chi2, 0.01);
  EXPECT_LT(c.largest_delta, 0.01);
  EXPECT_LE(c.unsolved, c.problems / 500);
}

TEST(WarmSolve, AnswersAsSolveDoesOverTenThousandProblems) {
  expect_the_same(compared(test::frustum_target(), {}, 10'000, 11));
}

TEST(WarmSolve, AnswersAsSolveDoesUnderSevenTimesTheNoise) {
  test::PnpSet set;
  set.sigma_rad = 60.0 * kRadPerArcsec;
  const Comparison c = compared(test::frustum_target(), set, 5'000, 12);
  expect_the_same(c);
  EXPECT_GT(c.ambiguous, 10) << "the set is to hold rivals";
}

TEST(WarmSolve, ReportsBothSolutionsOfCoplanarSensors) {
  test::PnpSet set;
  set.sigma_rad = 30.0 * kRadPerArcsec;
  set.min_sensors = 4;
  set.max_sensors = 4;
  const Comparison c = compared(test::top_plate_target(), set, 2'000, 13);
  EXPECT_LE(c.other_flags, flags_that_may_differ(c));
  EXPECT_LT(c.largest_distance_sigma, 0.1);
  EXPECT_GT(c.ambiguous, 500);
  EXPECT_LT(c.unsolved, c.problems / 20);
}

TEST(WarmSolve, ScalesWithTheTarget) {
  // The same view of a target of a thousandth and a hundred times the size, with the distance scaled alike.
  for (const double scale : {0.01, 100.0}) {
    test::PnpGenerator generator(test::frustum_target(), relief(), 14);
    Target target = test::frustum_target();
    for (SensorPlacement& s : target) s.position_m *= scale;
    for (int k = 0; k < 100; ++k) {
      const test::PnpProblem problem = generator.next();
      LighthouseFromBody prior = disturbed(problem.truth, generator);
      prior.t *= scale;
      const auto warm = solve_warm(target, problem.observations, {}, prior);
      const auto full = solve(target, problem.observations, {}, &prior);
      ASSERT_TRUE(warm.has_value());
      EXPECT_LT(sigmas_between(warm->estimate, full->estimate), 0.1);
    }
  }
}

TEST(WarmSolve, KeepsItsAnswerWhereTheBodysOriginLiesAside) {
  const Vector3 aside_m(0.3, -0.2, 0.5);
  Target target = test::frustum_target();
  for (SensorPlacement& s : target) s.position_m += aside_m;
  test::PnpGenerator generator(test::frustum_target(), relief(), 15);
  for (int k = 0; k < 300; ++k) {
    const test::PnpProblem problem = generator.next();
    LighthouseFromBody prior = disturbed(problem.truth, generator);
    prior.t -= prior.R * aside_m;
    const auto warm = solve_warm(target, problem.observations, {}, prior);
    const auto full = solve(target, problem.observations, {}, &prior);
    ASSERT_TRUE(warm.has_value());
    EXPECT_LT(sigmas_between(warm->estimate, full->estimate), 0.1);
    EXPECT_NEAR(warm->estimate.pdop_m_per_rad, full->estimate.pdop_m_per_rad, 0.01 * full->estimate.pdop_m_per_rad);
  }
}

TEST(WarmSolve, GivesAnOrthonormalRotation) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, relief(), 16);
  for (int k = 0; k < 100; ++k) {
    const test::PnpProblem problem = generator.next();
    const auto warm = solve_warm(target, problem.observations, {}, disturbed(problem.truth, generator));
    ASSERT_TRUE(warm.has_value());
    const Matrix3& R = warm->estimate.pose.R;
    EXPECT_LT((R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

class WarmSolveLeaves : public ::testing::Test {
 protected:
  Target target_ = test::frustum_target();
  test::PnpSet set_;
  test::PnpGenerator generator_{target_, eight(), 17};
  test::PnpProblem problem_ = generator_.next();
  SolveOptions options_;

  test::PnpSet eight() {
    set_.min_sensors = set_.max_sensors = 8;
    return set_;
  }
  bool answered() const { return solve_warm(target_, problem_.observations, options_, problem_.truth).has_value(); }
};

TEST_F(WarmSolveLeaves, NothingThatItCanAnswer) { EXPECT_TRUE(answered()); }

TEST_F(WarmSolveLeaves, CompetingHits) {
  Observation twin = problem_.observations[0];
  twin.theta_rad += 1e-3;
  problem_.observations.push_back(twin);
  EXPECT_FALSE(answered());
}

TEST_F(WarmSolveLeaves, AHitThatFitsNoRigidBody) {
  problem_.observations[3].theta_rad += 3e-3;
  EXPECT_FALSE(answered());
}

TEST_F(WarmSolveLeaves, BearingsThatAreNone) {
  problem_.observations[3].theta_rad = std::nan("");
  EXPECT_FALSE(answered());
  problem_.observations[3].theta_rad = kPi;
  EXPECT_FALSE(answered());
}

TEST_F(WarmSolveLeaves, ThreeSensors) {
  problem_.observations.resize(6);
  EXPECT_FALSE(answered());
}

TEST_F(WarmSolveLeaves, CorrelatedNoiseAndThePapersResidual) {
  options_.rho = 0.5;
  EXPECT_FALSE(answered());
  options_ = {};
  options_.residual = Residual::kTangent;
  EXPECT_FALSE(answered());
}

TEST_F(WarmSolveLeaves, APriorThatLooksElsewhere) {
  LighthouseFromBody prior = problem_.truth;
  prior.t = Vector3(prior.t.z(), prior.t.x(), prior.t.z());
  EXPECT_FALSE(solve_warm(target_, problem_.observations, options_, prior).has_value() &&
               !solve(target_, problem_.observations, options_, &prior).ok());
  prior.t = Vector3(0.0, 0.0, -1.0);
  EXPECT_FALSE(solve_warm(target_, problem_.observations, options_, prior).has_value());
  prior.t = Vector3::Zero();
  EXPECT_FALSE(solve_warm(target_, problem_.observations, options_, prior).has_value());
  prior.t = Vector3(0.0, 0.0, 1e9);
  EXPECT_FALSE(solve_warm(target_, problem_.observations, options_, prior).has_value());
}

TEST_F(WarmSolveLeaves, SensorsThatTheTargetHasNotOutOfIt) {
  problem_.observations.push_back({31, Axis::kX, 1.0});
  const auto warm = solve_warm(target_, problem_.observations, options_, problem_.truth);
  ASSERT_TRUE(warm.has_value());
  EXPECT_FALSE(warm->used[problem_.observations.size() - 1]);
}

}  // namespace
}  // namespace pharos::pose
