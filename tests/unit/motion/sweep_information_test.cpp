// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/sweep_information.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace pharos::motion {
namespace {

using Rows = Eigen::Matrix<double, 8, 6>;
using Column = Eigen::Matrix<double, 8, 1>;
using Noise = Eigen::Matrix<double, 8, 8>;

struct Sweep {
  Rows H;
  Column r;
  Noise R;
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
    const double misfit = sweep.r.dot(inverse * sweep.r) - right.dot(square.ldlt().solve(right));
    EXPECT_NEAR(information.misfit, misfit, 1e-9 * (1.0 + misfit));
    EXPECT_EQ(information.rank, 6);
    EXPECT_EQ(information.hits, 8);
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
  // Eight readings of one error of variance 0.9 (and a little of their own): chi-squared near 1 / 0.92.
  const SweepInformation information = summed(sweep);
  EXPECT_GT(information.misfit, 1.0);
  EXPECT_LT(information.misfit, 1.11);
}

}  // namespace
}  // namespace pharos::motion
