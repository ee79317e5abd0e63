// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {
namespace {

LighthouseFromBody off_by(const LighthouseFromBody& pose, double rad, double metres) {
  Vector6 delta;
  delta << rad, -rad, rad, metres, metres, -metres;
  return pose.moved_by(delta);
}

// Distance of two poses in sigmas of the first one's covariance.
double in_sigmas(const LighthousePoseEstimate& estimate, const LighthouseFromBody& pose) {
  const Vector6 difference = pose_difference(pose, estimate.pose);
  return std::sqrt(mahalanobis_squared<6>(difference, estimate.covariance));
}

TEST(Solve, PerfectBearingsGiveThePerfectPose) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.sigma_rad = 0.0;
  test::PnpGenerator generator(target, set, 1);
  for (int k = 0; k < 500; ++k) {
    const test::PnpProblem problem = generator.next();
    const auto solution = solve(target, problem.observations, {});
    ASSERT_TRUE(solution.ok());
    EXPECT_LT(rotation_angle_between(solution->estimate.pose.R, problem.truth.R), 1e-5);
    EXPECT_LT((solution->estimate.pose.t - problem.truth.t).norm(), 1e-5);
    EXPECT_LT(solution->estimate.residual_rms, 1e-9);
    EXPECT_EQ(solution->used.count(), problem.observations.size());
  }
}

TEST(Solve, MillimetresScaleTranslationAndLeaveRotation) {
  const Target metres = test::frustum_target();
  Target millimetres = metres;
  for (SensorPlacement& s : millimetres) s.position_m *= 1000.0;
  test::PnpGenerator generator(metres, {}, 2);
  for (int k = 0; k < 300; ++k) {
    const test::PnpProblem problem = generator.next();
    const auto a = solve(metres, problem.observations, {});
    const auto b = solve(millimetres, problem.observations, {});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_LT(rotation_angle_between(a->estimate.pose.R, b->estimate.pose.R), 1e-7);
    EXPECT_LT((1000.0 * a->estimate.pose.t - b->estimate.pose.t).norm(), 1e-3);
    EXPECT_NEAR(b->estimate.pdop_m_per_rad / a->estimate.pdop_m_per_rad, 1000.0, 1e-2);
    EXPECT_EQ(a->estimate.ambiguous(), b->estimate.ambiguous());
  }
}

TEST(Solve, OrderOfObservationsChangesNothing) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 3);
  for (int k = 0; k < 300; ++k) {
    test::PnpProblem problem = generator.next();
    const auto a = solve(target, problem.observations, {});
    std::shuffle(problem.observations.begin(), problem.observations.end(), generator.engine());
    const auto b = solve(target, problem.observations, {});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_LT(in_sigmas(a->estimate, b->estimate.pose), 0.03);
    EXPECT_EQ(a->estimate.ambiguous(), b->estimate.ambiguous());
  }
}

TEST(Solve, PoseIsARotationAndTheCovarianceIsPositiveDefinite) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 4);
  for (int k = 0; k < 300; ++k) {
    const auto solution = solve(target, generator.next().observations, {});
    ASSERT_TRUE(solution.ok());
    const Matrix3& R = solution->estimate.pose.R;
    EXPECT_NEAR((R.transpose() * R - Matrix3::Identity()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
    EXPECT_EQ(solution->estimate.covariance, solution->estimate.covariance.transpose());
    EXPECT_TRUE(positive_inverse<6>(solution->estimate.covariance)) << "not positive definite";
  }
}

TEST(Solve, PriorLeadsToTheSamePoseAsNoPrior) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 5);
  for (int k = 0; k < 500; ++k) {
    const test::PnpProblem problem = generator.next();
    const LighthouseFromBody prior = off_by(problem.truth, 0.05, 0.03);
    const auto a = solve(target, problem.observations, {});
    const auto b = solve(target, problem.observations, {}, &prior);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_LT(in_sigmas(a->estimate, b->estimate.pose), 0.05);
    EXPECT_EQ(a->estimate.ambiguous(), b->estimate.ambiguous());
  }
}

TEST(Solve, PriorThatIsFarOffDoesNoHarm) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 6);
  int different = 0;
  for (int k = 0; k < 300; ++k) {
    const test::PnpProblem problem = generator.next();
    const LighthouseFromBody prior = generator.random_pose();
    const auto a = solve(target, problem.observations, {});
    const auto b = solve(target, problem.observations, {}, &prior);
    ASSERT_TRUE(a.ok() && b.ok());
    different += in_sigmas(a->estimate, b->estimate.pose) < 0.05 ? 0 : 1;
  }
  EXPECT_EQ(different, 0);
}

TEST(Solve, ThreeSensorsDoWithAPriorAndKeepToIt) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 4;
  test::PnpGenerator generator(target, set, 7);
  int solved = 0;
  constexpr int kProblems = 300;
  for (int k = 0; k < kProblems; ++k) {
    const test::PnpProblem problem = generator.next();
    Observations three;
    for (std::size_t i = 0; i < 6; ++i) three.push_back(problem.observations[i]);
    const LighthouseFromBody prior = off_by(problem.truth, 0.01, 0.005);
    const auto solution = solve(target, three, {}, &prior);
    EXPECT_EQ(solve(target, three, {}).error(), Refusal::kTooFewSensors);
    if (!solution.ok()) continue;
    EXPECT_EQ(solution->estimate.observations, 6);
    solved += in_sigmas(solution->estimate, problem.truth) < 5.0 ? 1 : 0;
  }
  EXPECT_GT(solved, kProblems * 95 / 100);
}

TEST(Solve, SensorsWithOneAxisAreUsedAsWell) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 6;
  test::PnpGenerator generator(target, set, 8);
  for (int k = 0; k < 200; ++k) {
    const test::PnpProblem problem = generator.next();
    Observations some;  // the first four sensors with both axes, the others with y alone
    for (std::size_t i = 0; i < problem.observations.size(); ++i) {
      if (i < 8 || problem.observations[i].axis == Axis::kY) some.push_back(problem.observations[i]);
    }
    const auto all = solve(target, problem.observations, {});
    const auto solution = solve(target, some, {});
    ASSERT_TRUE(all.ok() && solution.ok());
    EXPECT_EQ(solution->estimate.observations, static_cast<int>(some.size()));
    EXPECT_GT(solution->estimate.sigma_position_m(), all->estimate.sigma_position_m());
  }
}

TEST(Solve, TangentResidualIsThePapersMinimum) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 6;
  set.sigma_rad = 60.0 * kRadPerArcsec;
  test::PnpGenerator generator(target, set, 9);
  SolveOptions tangent;
  tangent.sigma_rad = set.sigma_rad;
  tangent.residual = Residual::kTangent;
  double angle_square = 0.0, tangent_square = 0.0, nees = 0.0;
  constexpr int kProblems = 2000;
  for (int k = 0; k < kProblems; ++k) {
    const test::PnpProblem problem = generator.next();
    SolveOptions angle = tangent;
    angle.residual = Residual::kAngle;
    const auto a = solve(target, problem.observations, angle);
    const auto t = solve(target, problem.observations, tangent);
    ASSERT_TRUE(a.ok() && t.ok());
    angle_square += (a->estimate.pose.t - problem.truth.t).squaredNorm();
    tangent_square += (t->estimate.pose.t - problem.truth.t).squaredNorm();
    nees += test::nees_of(problem.truth, t->estimate) / 6.0 / kProblems;
  }
  // Its noise is not uniform, so it must be worse than the angles, and its covariance must include that.
  EXPECT_GT(std::sqrt(tangent_square / angle_square), 1.03);
  EXPECT_LT(std::sqrt(tangent_square / angle_square), 1.3);
  EXPECT_NEAR(nees, 1.0, 0.08);
}

TEST(Solve, FirstSolutionFitsBetterThanTheSecond) {
  const Target target = test::top_plate_target();
  test::PnpSet set;
  set.max_sensors = 4;
  test::PnpGenerator generator(target, set, 10);
  int ambiguous = 0;
  for (int k = 0; k < 500; ++k) {
    const auto solution = solve(target, generator.next().observations, {});
    ASSERT_TRUE(solution.ok());
    if (!solution->estimate.second) continue;
    ++ambiguous;
    EXPECT_GE(solution->estimate.second->delta_chi2, 0.0);
    EXPECT_LT(solution->estimate.second->delta_chi2, kAmbiguousDeltaChi2);
  }
  EXPECT_GT(ambiguous, 100);
}

TEST(Solve, SecondIsNotLookedForWhereNotWanted) {
  const Target target = test::top_plate_target();
  test::PnpSet set;
  set.max_sensors = 4;
  test::PnpGenerator generator(target, set, 11);
  SolveOptions options;
  options.look_for_second = false;
  for (int k = 0; k < 100; ++k) {
    const auto solution = solve(target, generator.next().observations, options);
    ASSERT_TRUE(solution.ok());
    EXPECT_FALSE(solution->estimate.ambiguous());
  }
}

TEST(Solve, TouchesNoHeap) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 12);
  test::PnpProblem problem = generator.next();
  // With competing hits and an outlier, so that the search runs too.
  problem.observations.push_back({problem.observations[0].sensor, Axis::kX, 1.5});
  problem.observations[3].theta_rad += 0.02;
  for (const Start start : {Start::kAuto, Start::kRpnp, Start::kDlt, Start::kHomography}) {
    SolveOptions options;
    options.start = start;
    const test::AllocationGuard guard;
    const auto solution = solve(target, problem.observations, options);
    EXPECT_EQ(guard.allocations(), 0u);
    (void)solution;
  }
}

}  // namespace
}  // namespace pharos::pose
