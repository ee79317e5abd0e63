// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/precision.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "pharos/pose/paper.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {
namespace {

// (14), (18), (19), (21) and (22) written out with full matrices in the paper's own unknowns.
Precision printed(const Target& target, const Vector3& phi, const Vector3& t, const SensorSet& sensors, double rho) {
  const auto n = static_cast<int>(sensors.count());
  Eigen::MatrixXd J(2 * n, 6);
  int row = 0;
  for (const SensorPlacement& s : target) {
    if (!sensors.test(s.sensor)) continue;
    J.middleRows(row, 2) = paper::angle_jacobian(phi, t, s.position_m);
    row += 2;
  }
  Eigen::MatrixXd R_theta(2 * n, 2 * n);
  for (int i = 0; i < 2 * n; ++i) {
    for (int j = 0; j < 2 * n; ++j) R_theta(i, j) = i == j ? 1.0 : (i + j) % 2 == 0 ? rho : 0.0;
  }
  const Eigen::MatrixXd pseudo = (J.transpose() * J).inverse() * J.transpose();
  const Matrix6 H = pseudo * R_theta * pseudo.transpose();
  const Matrix3 J_r = paper_right_jacobian(phi);
  Precision precision;
  precision.adop_deg_per_rad = kDegPerRad * std::sqrt((J_r * H.topLeftCorner<3, 3>() * J_r.transpose()).trace());
  precision.pdop_m_per_rad = std::sqrt(H.bottomRightCorner<3, 3>().trace());
  return precision;
}

TEST(Precision, AgreesWithTheEquationsAsPrinted) {
  const Target target = test::frustum_target();
  test::PnpGenerator generator(target, {}, 1);
  for (int k = 0; k < 100; ++k) {
    const test::PnpProblem problem = generator.next();
    const Vector3 phi = -rotation_log(problem.truth.R);  // passive
    for (const double rho : {0.0, kPaperRho, 0.97}) {
      const auto ours = precision_of(target, problem.truth, problem.seen, rho);
      const Precision expected = printed(target, phi, problem.truth.t, problem.seen, rho);
      ASSERT_TRUE(ours.ok());
      EXPECT_NEAR(ours->adop_deg_per_rad / expected.adop_deg_per_rad, 1.0, 1e-5);
      EXPECT_NEAR(ours->pdop_m_per_rad / expected.pdop_m_per_rad, 1.0, 1e-5);
    }
  }
}

TEST(Precision, SolverReportsThoseOfItsPose) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 6;
  test::PnpGenerator generator(target, set, 2);
  SolveOptions options;
  options.rho = kPaperRho;
  for (int k = 0; k < 100; ++k) {
    const test::PnpProblem problem = generator.next();
    const auto solution = solve(target, problem.observations, options);
    ASSERT_TRUE(solution.ok());
    const auto precision = precision_of(target, solution->estimate.pose, problem.seen, options.rho);
    ASSERT_TRUE(precision.ok());
    EXPECT_NEAR(solution->estimate.adop_deg_per_rad / precision->adop_deg_per_rad, 1.0, 1e-3);
    EXPECT_NEAR(solution->estimate.pdop_m_per_rad / precision->pdop_m_per_rad, 1.0, 1e-3);
    // (24).
    EXPECT_NEAR(solution->estimate.sigma_rotation_rad() * kDegPerRad,
                solution->estimate.adop_deg_per_rad * options.sigma_rad, 1e-9);
  }
}

TEST(Precision, SensorIsVisibleUpToTheIncidenceGiven) {
  Target target;
  target.push_back({3, {0, 0, 0}, {0, 0, 1}});
  for (const double incidence_deg : {0.0, 30.0, 59.0, 61.0, 89.0, 120.0, 180.0}) {
    // Straight ahead of the station; at 0 deg the body's z points to it.
    const LighthouseFromBody pose{rotation_exp({kPi - incidence_deg * kRadPerDeg, 0, 0}), {0, 0, 2}};
    EXPECT_EQ(visible_sensors(target, pose).test(3), incidence_deg < 60.0) << incidence_deg;
    EXPECT_EQ(visible_sensors(target, pose, 90.0 * kRadPerDeg).test(3), incidence_deg < 90.0) << incidence_deg;
  }
}

TEST(Precision, SensorWithoutNormalOrAheadOfTheStationOnly) {
  Target target;
  target.push_back({0, {0, 0, 0}, Vector3::Zero()});
  EXPECT_TRUE(visible_sensors(target, {rotation_exp({0.3, 2.0, 1.0}), {0, 0, 2}}).test(0));
  EXPECT_FALSE(visible_sensors(target, {Matrix3::Identity(), {0, 0, -2}}).test(0));
}

TEST(Precision, RefusesForTheReasonThatHolds) {
  const Target target = test::frustum_target();
  const LighthouseFromBody pose{rotation_exp({kPi, 0, 0}), {0, 0, 2}};
  EXPECT_EQ(precision_of(target, pose, 0x3, 0.0).error(), Refusal::kTooFewSensors);
  EXPECT_EQ(precision_of(target, {pose.R, {0, 0, -2}}, 0xFF, 0.0).error(), Refusal::kBehindStation);
  EXPECT_EQ(precision_of(target, {pose.R, {0, 0, std::nan("")}}, 0xFF, 0.0).error(), Refusal::kBadInput);
  Target line;
  for (std::uint8_t k = 0; k < 4; ++k) line.push_back({k, {0.02 * k, 0.01 * k, 0.0}, Vector3::Zero()});
  EXPECT_EQ(precision_of(line, pose, 0xF, 0.0).error(), Refusal::kDegenerate);
}

}  // namespace
}  // namespace pharos::pose
