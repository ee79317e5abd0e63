// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/sweep_information.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "pharos/base/units.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "pharos/motion/sweep_fit.hpp"

namespace pharos::motion {
namespace {

// Dynamic numbers of rows: products of these sizes, if fixed, are unrolled at some cost of compile time.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;
using Column = Eigen::VectorXd;
using Noise = Eigen::MatrixXd;

struct Sweep {
  Rows H = Rows(8, 6);
  Column r = Column(8);
  Noise R = Noise(8, 8);
  double common = 0.0;
};

Sweep random_sweep(unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Sweep sweep;
  sweep.common = 0.9;
  sweep.R.setConstant(sweep.common);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 6; ++j) sweep.H(i, j) = normal(engine);
    sweep.r[i] = normal(engine);
    sweep.R(i, i) += 0.1 + 0.02 * i;
  }
  return sweep;
}

SweepInformation summed(const Sweep& sweep) {
  InformationSums sums;
  for (int i = 0; i < 8; ++i) sums.add(sweep.H.row(i).transpose(), sweep.r[i], 1.0 / (sweep.R(i, i) - sweep.common));
  return sums.close(sweep.common);
}

TEST(SweepInformation, SumsEqualTheDenseNoiseMatrixInverted) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Sweep sweep = random_sweep(seed);
    const SweepInformation information = summed(sweep);
    const Noise inverse = sweep.R.inverse();
    const Matrix6 square = sweep.H.transpose() * inverse * sweep.H;
    const Vector6 right = sweep.H.transpose() * inverse * sweep.r;
    EXPECT_LT((information.factor * information.factor.transpose() - square).norm(), 1e-9 * square.norm());
    EXPECT_LT((information.factor * information.whitened - right).norm(), 1e-9 * right.norm());
    const double residual_chi2 = sweep.r.dot(inverse * sweep.r) - mahalanobis_squared<6>(right, square);
    EXPECT_NEAR(information.residual_chi2, residual_chi2, 1e-9 * (1.0 + residual_chi2));
    EXPECT_EQ(information.rank, 6);
    EXPECT_EQ(information.hits, 8);
  }
}

// A part of the noise that is linear in where the hits are.
TEST(SweepInformation, SumsWithSharedPlacesEqualTheDenseNoiseMatrixInverted) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Sweep sweep = random_sweep(seed);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Matrix3 root;
    Eigen::Matrix<double, Eigen::Dynamic, 3> Q(8, 3);
    for (int k = 0; k < 9; ++k) root(k / 3, k % 3) = normal(engine);
    if (seed % 2 == 1) root.col(2).setZero();  // of rank two
    for (int k = 0; k < 24; ++k) Q(k / 3, k % 3) = normal(engine);
    const Matrix3 W = root * root.transpose();
    SharedSums sums(W, sweep.common);
    for (int i = 0; i < 8; ++i) {
      sums.add(sweep.H.row(i).transpose(), sweep.r[i], 1.0 / (sweep.R(i, i) - sweep.common), Q.row(i).transpose());
    }
    const SweepInformation information = sums.close();
    const double before = sweep.R.determinant();
    sweep.R += Q * W * Q.transpose();
    const Noise inverse = sweep.R.inverse();
    const Matrix6 square = sweep.H.transpose() * inverse * sweep.H;
    const Vector6 right = sweep.H.transpose() * inverse * sweep.r;
    EXPECT_LT((information.factor * information.factor.transpose() - square).norm(), 1e-9 * square.norm());
    EXPECT_LT((information.factor * information.whitened - right).norm(), 1e-9 * right.norm());
    const double residual_chi2 = sweep.r.dot(inverse * sweep.r) - mahalanobis_squared<6>(right, square);
    EXPECT_NEAR(information.residual_chi2, residual_chi2, 1e-8 * (1.0 + residual_chi2));
    EXPECT_NEAR(sums.log_determinant(), std::log(sweep.R.determinant() / before), 1e-8);
  }
}

TEST(SweepInformation, ADirectionThatNothingSeesHasNoRank) {
  Sweep sweep = random_sweep(3);
  sweep.H.col(4).setZero();
  const SweepInformation information = summed(sweep);
  EXPECT_EQ(information.rank, 5);
  EXPECT_EQ(information.factor.col(4).norm(), 0.0);
  EXPECT_EQ(information.factor.row(4).norm(), 0.0);
}

TEST(SweepInformation, AShiftOfAllHitsCountsAsOneErrorNotAsEight) {
  Sweep sweep = random_sweep(5);
  sweep.H.setZero();
  sweep.r.setConstant(1.0);
  // Eight measurements with one common error of variance 0.9 (and a little noise of their own): chi-squared near 1 /
  // 0.92.
  const SweepInformation information = summed(sweep);
  EXPECT_GT(information.residual_chi2, 1.0);
  EXPECT_LT(information.residual_chi2, 1.11);
}

// Stationary sensors in recordings: pulses of 25 to 50 ticks scatter by 5 to 10 arcsec, those of 200 by 1 to 3.
TEST(SweepFit, ANarrowHitCountsLess) {
  Target target;
  lighthouse::SweepBearings bearings;
  constexpr std::array<std::uint16_t, 4> kWidths = {0, 208, 52, 20};  // 0: unknown
  for (std::uint8_t i = 0; i < kWidths.size(); ++i) {
    target.push_back({i, Vector3(0.02 * i, 0.01 * i * i, 0.0), Vector3::Zero()});
    bearings.push_back({1000, kPi / 2 - std::atan2(0.02 * i, 2.0), kWidths[i], i});
  }
  StateEstimate state_estimate;
  state_estimate.pose.t = {0.0, 0.0, 2.0};
  state_estimate.covariance = state_estimate.gate_covariance = 1e-6 * Matrix6::Identity();
  constexpr double kOwn = 3.0 * kRadPerArcsec;
  const SweepFit fit = fit_sweep(bearings, Axis::kX, {&target, nullptr}, state_estimate, 1000, {kOwn, kOwn});
  ASSERT_EQ(fit.used.size(), kWidths.size());
  std::array<double, kWidths.size()> arcsec{};
  for (const HitFit& hit : fit.used) arcsec[bearings[hit.bearing].sensor] = std::sqrt(hit.variance) * kArcsecPerRad;
  EXPECT_NEAR(arcsec[0], 3.0, 1e-9);
  EXPECT_NEAR(arcsec[1], 3.0, 0.05);
  EXPECT_NEAR(arcsec[2], std::hypot(3.0, 5.0), 1e-6);
  EXPECT_NEAR(arcsec[3], std::hypot(3.0, 25.0), 1e-6);
}

}  // namespace
}  // namespace pharos::motion
