// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/kinematic_state.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace pharos::motion {
namespace {

// Dynamic sizes: products of fixed sizes like these are unrolled, which takes the compiler half a minute.
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd whole(const MovingState& s) {
  MatrixXd P(18, 18);
  P << s.pp, s.rp.transpose(), s.ap.transpose(), s.rp, s.rr, s.ar.transpose(), s.ap, s.ar, s.aa;
  return P;
}

MatrixXd some_covariance(int size, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  MatrixXd root(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) root(i, j) = 0.01 * normal(engine);
  }
  return root * root.transpose();
}

// Of pose, rate and acceleration; what P has beyond them is left out.
void set_covariance(MovingState& s, const MatrixXd& P) {
  s.pp = P.block<6, 6>(0, 0);
  s.rp = P.block<6, 6>(6, 0);
  s.rr = P.block<6, 6>(6, 6);
  s.ap = P.block<6, 6>(12, 0);
  s.ar = P.block<6, 6>(12, 6);
  s.aa = P.block<6, 6>(12, 12);
}

MovingState some_state(unsigned seed) {
  const MatrixXd P = some_covariance(18, seed);
  MovingState s;
  s.pose = {rotation_exp({0.3, -0.5, 0.9}), {0.2, -0.1, 2.0}};
  s.rate << 0.4, -0.3, 0.8, 0.1, 0.2, -0.3;
  s.acceleration << 0.5, 0.1, -0.2, 0.3, -0.4, 0.2;
  set_covariance(s, P);
  return s;
}

MovingState moved(const MovingState& s, const VectorXd& error) {
  MovingState other = s;
  other.pose = s.pose.moved_by(error.head<6>());
  other.rate += error.segment<6>(6);
  other.acceleration += error.tail<6>();
  return other;
}

TEST(MovingState, PredictsTheCovarianceThatItsMeanHasBySmallDifferences) {
  constexpr double kStep_s = 0.008, kSmall = 1e-6;
  const MovingState s = some_state(1);
  MovingState end = s;
  end.predict_mean(kStep_s);
  MatrixXd F(18, 18);
  for (int k = 0; k < 18; ++k) {
    VectorXd error = VectorXd::Zero(18);
    error[k] = kSmall;
    MovingState other = moved(s, error);
    other.predict_mean(kStep_s);
    F.col(k) << pose_difference(other.pose, end.pose), other.rate - end.rate, other.acceleration - end.acceleration;
  }
  F /= kSmall;
  MovingState predicted = s;
  predicted.predict(kStep_s, 0.0, 0.0);
  const MatrixXd expected = F * whole(s) * F.transpose();
  // The neglected term is half the rotation of one step (0.4 %) of the rate's part.
  EXPECT_LT((whole(predicted) - expected).norm(), 1e-3 * expected.norm());
  EXPECT_LT((predicted.pose.R - end.pose.R).norm(), 1e-12);
}

TEST(MovingState, WhiteJerkGrowsAsItsIntegralsSay) {
  MovingState s;
  s.pose.t = {0.0, 0.0, 2.0};
  constexpr double q = 3.0, kStep_s = 0.01;
  constexpr int kSteps = 50;
  for (int k = 0; k < kSteps; ++k) s.predict(kStep_s, 0.0, q);
  const double T = kSteps * kStep_s;
  EXPECT_NEAR(s.pp(5, 5), q * std::pow(T, 5) / 20.0, 1e-9);
  EXPECT_NEAR(s.rr(5, 5), q * std::pow(T, 3) / 3.0, 1e-9);
  EXPECT_NEAR(s.aa(5, 5), q * T, 1e-9);
  EXPECT_NEAR(s.ap(5, 5), q * std::pow(T, 3) / 6.0, 1e-9);
  EXPECT_EQ(s.pp(0, 0), 0.0);
}

TEST(MovingState, ACorrectionIsKalmans) {
  MovingState s = some_state(2);
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  InformationSums sums;
  MatrixXd H = MatrixXd::Zero(7, 18);
  VectorXd r(7);
  constexpr double kOwn = 1e-4, kCommon = 9e-4;
  MatrixXd R = MatrixXd::Constant(7, 7, kCommon);
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 6; ++j) H(i, j) = normal(engine);
    r[i] = 0.01 * normal(engine);
    R(i, i) += kOwn;
    sums.add(H.row(i).head<6>().transpose(), r[i], 1.0 / kOwn);
  }
  const SweepInformation information = sums.close(kCommon);
  const MatrixXd P = whole(s);
  const MatrixXd S = H * P * H.transpose() + R;
  const MatrixXd K = P * H.transpose() * S.inverse();
  const VectorXd shift = K * r;
  const MatrixXd expected = P - K * H * P;

  const MovingState before = s;
  const Innovation innovation = innovation_of(information, s.pp, Vector6::Zero());
  s.correct(information, innovation, false);
  EXPECT_LT((whole(s) - expected).norm(), 1e-9 * P.norm());
  EXPECT_LT((pose_difference(s.pose, before.pose) - shift.head<6>()).norm(), 1e-9);
  EXPECT_LT((s.rate - before.rate - shift.segment<6>(6)).norm(), 1e-9);
  EXPECT_LT((s.acceleration - before.acceleration - shift.tail<6>()).norm(), 1e-9);
  EXPECT_NEAR(innovation.chi2 + information.residual_chi2, r.dot(S.inverse() * r), 1e-6);
  EXPECT_NEAR(innovation.log_det, std::log(S.determinant() / R.determinant()), 1e-8);
}

MatrixXd whole_with_second(const MovingState& s) {
  MatrixXd P(24, 24);
  P.topLeftCorner<18, 18>() = whole(s);
  P.bottomLeftCorner<6, 18>() << s.second.sp, s.second.sr, s.second.sa;
  P.topRightCorner<18, 6>() = P.bottomLeftCorner<6, 18>().transpose();
  P.bottomRightCorner<6, 6>() = s.second.ss;
  return P;
}

MovingState some_linked_state(unsigned seed) {
  const MatrixXd P = some_covariance(24, seed);
  MovingState s = some_state(seed);
  set_covariance(s, P);
  s.second.pose = {rotation_exp({0.1, 0.8, -0.2}), {1.5, 0.2, -0.4}};
  s.second.sp = P.block<6, 6>(18, 0);
  s.second.sr = P.block<6, 6>(18, 6);
  s.second.sa = P.block<6, 6>(18, 12);
  s.second.ss = P.block<6, 6>(18, 18);
  return s;
}

// By finite differences: change of the body's pose in the second station's frame for a motion of the body and of that
// station.
TEST(SecondView, KnowsHowErrorsOfBodyAndStationLookFromTheSecondStation) {
  constexpr double kSmall = 1e-6;
  const MovingState s = some_linked_state(3);
  const SecondView view(s.pose, s.second.pose);
  for (int k = 0; k < 6; ++k) {
    Vector6 error = Vector6::Zero();
    error[k] = kSmall;
    const Vector6 by_body = pose_difference(s.second.pose * s.pose.moved_by(error), view.pose) / kSmall;
    const Vector6 by_second = pose_difference(s.second.pose.moved_by(error) * s.pose, view.pose) / kSmall;
    EXPECT_LT((by_body - view.by_body.col(k)).norm(), 1e-5) << k;
    EXPECT_LT((by_second - view.by_second.col(k)).norm(), 1e-5) << k;
  }
}

TEST(SecondView, TimeCarriesItsShareOfTheCovariance) {
  constexpr double kStep_s = 0.008, kSmall = 1e-6;
  const MovingState s = some_linked_state(4);
  MovingState end = s;
  end.predict_mean(kStep_s);
  MatrixXd F = MatrixXd::Identity(24, 24);
  for (int k = 0; k < 18; ++k) {
    VectorXd error = VectorXd::Zero(18);
    error[k] = kSmall;
    MovingState other = moved(s, error);
    other.predict_mean(kStep_s);
    F.col(k).head<18>() << pose_difference(other.pose, end.pose), other.rate - end.rate,
        other.acceleration - end.acceleration;
    F.col(k).head<18>() /= kSmall;
  }
  MovingState predicted = s;
  predicted.predict_second(kStep_s);
  predicted.predict(kStep_s, 0.0, 0.0);
  const MatrixXd expected = F * whole_with_second(s) * F.transpose();
  EXPECT_LT((whole_with_second(predicted) - expected).norm(), 1e-3 * expected.norm());
}

// Hits of either station correct the body and the second station by the Kalman gain.
TEST(SecondView, ACorrectionOfEitherStationIsKalmans) {
  for (const bool second : {false, true}) {
    MovingState s = some_linked_state(5);
    std::mt19937_64 engine(9);
    std::normal_distribution<double> normal;
    const SecondView view(s.pose, s.second.pose);
    MatrixXd by_state = MatrixXd::Zero(6, 24);
    by_state.leftCols<6>() = second ? view.by_body : Matrix6(Matrix6::Identity());
    if (second) by_state.rightCols<6>() = view.by_second;
    InformationSums sums;
    MatrixXd H(7, 24);
    VectorXd r(7);
    constexpr double kOwn = 1e-4, kCommon = 9e-4;
    MatrixXd R = MatrixXd::Constant(7, 7, kCommon);
    for (int i = 0; i < 7; ++i) {
      Vector6 h;
      for (int j = 0; j < 6; ++j) h[j] = normal(engine);
      H.row(i) = h.transpose() * by_state;
      r[i] = 0.01 * normal(engine);
      R(i, i) += kOwn;
      sums.add(h, r[i], 1.0 / kOwn);
    }
    const SweepInformation information = sums.close(kCommon);
    const MatrixXd P = whole_with_second(s);
    const MatrixXd K = P * H.transpose() * (H * P * H.transpose() + R).inverse();
    const VectorXd shift = K * r;
    const MovingState before = s;
    if (second) {
      const Matrix6 seen = seen_covariance(view, s.pp, s.second);
      s.correct_second(information, innovation_of(information, seen, Vector6::Zero()), view);
    } else {
      s.correct(information, innovation_of(information, s.pp, Vector6::Zero()), true);
    }
    EXPECT_LT((whole_with_second(s) - (P - K * H * P)).norm(), 1e-9 * P.norm());
    EXPECT_LT((pose_difference(s.pose, before.pose) - shift.head<6>()).norm(), 1e-9);
    EXPECT_LT((s.rate - before.rate - shift.segment<6>(6)).norm(), 1e-9);
    EXPECT_LT((pose_difference(s.second.pose, before.second.pose) - shift.tail<6>()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace pharos::motion
