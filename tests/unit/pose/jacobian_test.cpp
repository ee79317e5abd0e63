// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>

#include "pharos/pose/hit_candidates.hpp"
#include "pharos/pose/linearise.hpp"
#include "pharos/pose/paper.hpp"
#include "pharos/pose/refine.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {
namespace {

constexpr double kStep = 1e-6;

// Central differences of a vector function of six unknowns.
template <int Rows>
Eigen::Matrix<double, Rows, 6> differences(const std::function<Eigen::Matrix<double, Rows, 1>(const Vector6&)>& f,
                                           const Vector6& at) {
  Eigen::Matrix<double, Rows, 6> jacobian;
  for (int k = 0; k < 6; ++k) {
    const Vector6 step = kStep * Vector6::Unit(k);
    jacobian.col(k) = (f(at + step) - f(at - step)) / (2.0 * kStep);
  }
  return jacobian;
}

Vector6 some_psi(test::PnpGenerator& generator) {
  Vector6 psi;
  psi << generator.uniform(-1.5, 1.5), generator.uniform(-1.5, 1.5), generator.uniform(-1.5, 1.5),
      generator.uniform(-1.0, 1.0), generator.uniform(-1.0, 1.0), generator.uniform(1.0, 4.0);
  return psi;
}

TEST(PaperEquations, RotationFiveIsTheFormulaAsPrinted) {
  const Vector3 phi(0.4, -1.1, 0.7);
  const double angle = phi.norm();
  const Vector3 e = phi / angle;
  const Matrix3 printed =
      std::cos(angle) * Matrix3::Identity() + (1.0 - std::cos(angle)) * e * e.transpose() - std::sin(angle) * skew(e);
  EXPECT_NEAR((paper_rotation(phi) - printed).norm(), 0.0, 1e-14);
}

TEST(PaperEquations, JacobianNineIsTheFormulaAsPrinted) {
  const Vector3 phi(0.4, -1.1, 0.7);
  const double angle = phi.norm();
  const Vector3 e = phi / angle;
  const double s = std::sin(angle) / angle;
  const Matrix3 printed =
      s * Matrix3::Identity() + (1.0 - s) * e * e.transpose() + (std::cos(angle) - 1.0) / angle * skew(e);
  EXPECT_NEAR((paper_right_jacobian(phi) - printed).norm(), 0.0, 1e-14);
}

TEST(PaperEquations, PointJacobianEightAgreesWithDifferences) {
  test::PnpGenerator generator(test::frustum_target(), {}, 1);
  const Vector3 body(0.05, -0.02, 0.06);
  for (int k = 0; k < 50; ++k) {
    const Vector6 psi = some_psi(generator);
    const auto numeric =
        differences<3>([&](const Vector6& v) { return paper::point(v.head<3>(), v.tail<3>(), body); }, psi);
    const Vector3 p = paper::point(psi.head<3>(), psi.tail<3>(), body);
    EXPECT_NEAR((paper::point_jacobian(psi.head<3>(), psi.tail<3>(), p) - numeric).norm(), 0.0, 1e-9);
  }
}

TEST(PaperEquations, ResidualJacobianElevenAgreesWithDifferences) {
  test::PnpGenerator generator(test::frustum_target(), {}, 2);
  const Vector3 body(0.05, -0.02, 0.06);
  for (int k = 0; k < 50; ++k) {
    const Vector6 psi = some_psi(generator);
    const auto numeric = differences<2>(
        [&](const Vector6& v) -> Vector2 {
          return paper::residual(paper::point(v.head<3>(), v.tail<3>(), body), {1.3, 1.7});
        },
        psi);
    EXPECT_NEAR((paper::residual_jacobian(psi.head<3>(), psi.tail<3>(), body) - numeric).norm(), 0.0, 1e-8);
  }
}

TEST(PaperEquations, AngleJacobianThirteenAgreesWithDifferencesOfTheBearings) {
  test::PnpGenerator generator(test::frustum_target(), {}, 3);
  const Vector3 body(0.05, -0.02, 0.06);
  for (int k = 0; k < 50; ++k) {
    const Vector6 psi = some_psi(generator);
    const auto numeric = differences<2>(
        [&](const Vector6& v) -> Vector2 {
          const Vector3 p = paper::point(v.head<3>(), v.tail<3>(), body);
          return {test::bearing_of(p, Axis::kX), test::bearing_of(p, Axis::kY)};
        },
        psi);
    EXPECT_NEAR((paper::angle_jacobian(psi.head<3>(), psi.tail<3>(), body) - numeric).norm(), 0.0, 1e-8);
  }
}

// The left error of the solver and the paper's phi: R = R(phi), exp([delta]x) R(phi) = R(phi - J_r^-1 delta), so that
// the paper's Jacobian times d psi = (-J_r^-1 delta_rot, delta_trans) is the solver's times delta.
TEST(PaperEquations, LeftErrorJacobianIsThePapersInOtherUnknowns) {
  test::PnpGenerator generator(test::frustum_target(), {}, 4);
  const Vector3 body(0.05, -0.02, 0.06);
  const Vector6 psi = some_psi(generator);
  const LighthouseFromBody pose{paper_rotation(psi.head<3>()), psi.tail<3>()};
  Matrix6 to_psi = Matrix6::Identity();
  to_psi.topLeftCorner<3, 3>() = -paper_right_jacobian(psi.head<3>()).inverse();
  const paper::Matrix26 printed = paper::angle_jacobian(psi.head<3>(), psi.tail<3>(), body) * to_psi;
  EXPECT_NEAR((printed.row(0).transpose() - jacobian_of(body, Axis::kX, pose)).norm(), 0.0, 1e-13);
  EXPECT_NEAR((printed.row(1).transpose() - jacobian_of(body, Axis::kY, pose)).norm(), 0.0, 1e-13);
}

class Linearisation : public ::testing::TestWithParam<Residual> {};

TEST_P(Linearisation, RowsAgreeWithDifferences) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 5);
  const test::PnpProblem problem = generator.next();
  HitCandidates hits;
  ASSERT_TRUE(collect_hit_candidates(target, problem.observations, hits));
  for (int i = 0; i < hits.sensors(); ++i) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const auto numeric = differences<1>(
          [&](const Vector6& delta) {
            const Row row = row_of(hits.table, i, axis, problem.truth.moved_by(delta), GetParam());
            return Eigen::Matrix<double, 1, 1>(row.residual);
          },
          Vector6::Zero());
      const Row row = row_of(hits.table, i, axis, problem.truth, GetParam());
      EXPECT_NEAR((row.jacobian.transpose() - numeric).norm(), 0.0, 1e-8);
    }
  }
}

TEST_P(Linearisation, SumsAreThoseOfTheRows) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = set.max_sensors = 7;  // odd: the padding entry takes part
  test::PnpGenerator generator(target, set, 6);
  const test::PnpProblem problem = generator.next();
  HitCandidates hits;
  ASSERT_TRUE(collect_hit_candidates(target, problem.observations, hits));
  hits.choose(2, Axis::kY, HitCandidates::kNone);
  Vector6 away;
  away << 0.3, -0.2, 0.1, 0.1, 0.05, 0.2;  // far enough for residuals beyond the series of the arctangent
  const LighthouseFromBody pose = problem.truth.moved_by(away);
  Matrix6 matrix = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double cost = 0.0;
  for (int i = 0; i < hits.sensors(); ++i) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      if (!hits.table.seen(i, axis)) continue;
      const Row row = row_of(hits.table, i, axis, pose, GetParam());
      matrix += row.jacobian * row.jacobian.transpose();
      gradient += row.jacobian * row.residual;
      cost += row.residual * row.residual;
    }
  }
  const NormalEquations sums = linearise(hits.table, pose, GetParam());
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(sums.gradient[i], gradient[static_cast<int>(i)], 1e-12);
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_NEAR(sums.matrix(i, j), matrix(static_cast<int>(i), static_cast<int>(j)), 1e-12);
    }
  }
  EXPECT_NEAR(sums.cost, cost, 1e-12);
  EXPECT_NEAR(cost_of(hits.table, pose, GetParam()), cost, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(BothResiduals, Linearisation, ::testing::Values(Residual::kAngle, Residual::kTangent));

TEST(Refinement, StepIsARotationThatAgreesWithTheExponentialToThirdOrder) {
  const LighthouseFromBody pose{rotation_exp({0.3, 0.8, -1.0}), {0.1, 0.2, 3.0}};
  const Vector6 delta = 1e-3 * (Vector6() << 1.0, -2.0, 0.5, 1.0, 1.0, 1.0).finished();
  const LighthouseFromBody stepped = moved(pose, {delta[0], delta[1], delta[2], delta[3], delta[4], delta[5]});
  EXPECT_NEAR((stepped.R.transpose() * stepped.R - Matrix3::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR((stepped.R - pose.moved_by(delta).R).norm(), 0.0, 1e-8);
  EXPECT_EQ(stepped.t, pose.moved_by(delta).t);
}

}  // namespace
}  // namespace pharos::pose
