// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/symmetric.hpp"

#include <gtest/gtest.h>

#include <random>

#include "pharos/geometry/rotation.hpp"

namespace pharos {
namespace {

template <int N>
Eigen::Matrix<double, N, N> random_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Matrix<double, N, N>::NullaryExpr([&] { return normal(random); });
}

template <int N>
void expect_solved(std::mt19937& random) {
  const Eigen::Matrix<double, N, N> L = random_matrix<N>(random);
  const Eigen::Matrix<double, N, N> P = L * L.transpose();
  const Eigen::Matrix<double, N, 1> white = random_matrix<N>(random).col(0);
  const Eigen::Matrix<double, N, 1> b = P * white;
  EXPECT_LT((P * solve_symmetric<N>(P, b) - b).norm(), 1e-9 * b.norm()) << N;
  const Eigen::Matrix<double, N, 1> d = L * white;
  EXPECT_NEAR(mahalanobis_squared<N>(d, P), white.squaredNorm(), 1e-7 * white.squaredNorm()) << N;
}

TEST(Symmetric, SystemsAreSolvedAndDifferencesWhitened) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    expect_solved<3>(random);
    expect_solved<5>(random);
    expect_solved<6>(random);
  }
}

TEST(Symmetric, AnIndefiniteSystemIsSolvedAsWell) {
  const Vector3 x = solve_symmetric<3>(Vector3(2.0, -4.0, 0.5).asDiagonal().toDenseMatrix(), Vector3(2.0, 4.0, 1.0));
  EXPECT_LT((x - Vector3(1.0, -1.0, 2.0)).norm(), 1e-15);
}

template <int N>
void expect_decomposed(std::mt19937& random) {
  const Eigen::Matrix<double, N, N> half = random_matrix<N>(random);
  Eigen::Matrix<double, N, N> A = half + half.transpose();
  const SymmetricEigen<N> eigen = symmetric_eigen<N>(A);
  const Eigen::Matrix<double, N, N> back = eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose();
  EXPECT_LT((back - A).norm(), 1e-12 * A.norm()) << N;
  const Eigen::Matrix<double, N, N> gram = eigen.vectors.transpose() * eigen.vectors;
  EXPECT_TRUE(gram.isIdentity(1e-12)) << N;
  for (int i = 1; i < N; ++i) EXPECT_LE(eigen.values[i - 1], eigen.values[i]) << N;
}

TEST(Symmetric, EigenvectorsAreAscendingOrthonormalAndGiveTheMatrixBack) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    expect_decomposed<3>(random);
  }
}

TEST(Rotation, BetweenDirectionsItIsTheSmallest) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3 a = random_matrix<3>(random).col(0), b = random_matrix<3>(random).col(0);
    const Matrix3 R = rotation_between(a, b);
    EXPECT_LT((R * a.normalized() - b.normalized()).norm(), 1e-12);
    EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12));
    EXPECT_NEAR(rotation_log(R).norm(), std::acos(a.normalized().dot(b.normalized())), 1e-7);
  }
  const Vector3 z = Vector3::UnitZ();
  EXPECT_TRUE(rotation_between(z, 2.0 * z).isIdentity(1e-15));
  for (const Vector3& a : {z, Vector3(1.0, 2.0, -0.5), Vector3(-1.0, 0.0, 0.0)}) {
    for (const double off : {0.0, 1e-13, 1e-9, 1e-7}) {
      const Vector3 b = -a + off * a.unitOrthogonal();
      const Matrix3 R = rotation_between(a, b);
      EXPECT_LT((R * a.normalized() - b.normalized()).norm(), 1e-7) << "a half turn, off by " << off;
      EXPECT_TRUE((R * R.transpose()).isIdentity(1e-7));
      EXPECT_NEAR(R.determinant(), 1.0, 1e-7);
    }
  }
}

}  // namespace
}  // namespace pharos
