// SPDX-License-Identifier: Apache-2.0
#include "host/linear/dense.hpp"

#include <gtest/gtest.h>

#include <random>

#include "pharos/geometry/rotation.hpp"

namespace pharos::host {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(Dense, EigenvectorsAreAscendingOrthonormalAndGiveTheMatrixBack) {
  std::mt19937 random(1);
  for (const int size : {1, 4, 18}) {
    const Eigen::MatrixXd half = random_matrix(size, size, random);
    const Eigen::MatrixXd A = half + half.transpose();
    const DenseEigen eigen = dense_eigen(A);
    for (int i = 1; i < size; ++i) EXPECT_LE(eigen.values[i - 1], eigen.values[i]);
    EXPECT_TRUE((eigen.vectors.transpose() * eigen.vectors).isIdentity(1e-12)) << size;
    EXPECT_TRUE((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose()).isApprox(A, 1e-12)) << size;
  }
}

TEST(Dense, ASquareIsThatOfTheWhitenedDifference) {
  std::mt19937 random(2);
  const Eigen::MatrixXd L = random_matrix(7, 7, random);
  const Eigen::VectorXd white = random_matrix(7, 1, random);
  EXPECT_NEAR(dense_mahalanobis_squared(L * white, L * L.transpose()), white.squaredNorm(), 1e-7);
  EXPECT_LT((L * L.transpose() * dense_solve(L * L.transpose(), white) - white).norm(), 1e-9);
}

TEST(Dense, TheNearestRotationIsThatOfTheVectorsAlsoWhenTheyAreNoisyOrInAPlane) {
  const Matrix3 R = rotation_exp(Vector3(0.4, -2.0, 0.9));
  std::mt19937 random(3);
  for (const double thickness : {1.0, 1e-9}) {
    Matrix3 C = Matrix3::Zero();
    for (int i = 0; i < 20; ++i) {
      Vector3 b = random_matrix(3, 1, random);
      b.z() *= thickness;
      C += R * b * b.transpose();
    }
    const NearestRotation found = nearest_rotation(C);
    EXPECT_LT(rotation_angle_between(found.R, R), 1e-7) << thickness;
    EXPECT_NEAR(found.R.determinant(), 1.0, 1e-12);
    EXPECT_GE(found.singular_values[1], found.singular_values[2]);
  }
}

// A mirrored set has no rotation that fits; the answer is a rotation nevertheless, and none near it is better.
TEST(Dense, OfAMirroredSetTheBestRotationIsFound) {
  const Matrix3 C = Vector3(3.0, 2.0, -1.0).asDiagonal();
  const Matrix3 R = nearest_rotation(C).R;
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  const double best = (R.transpose() * C).trace();
  for (const Vector3& turn : {Vector3(0.1, 0, 0), Vector3(0, -0.1, 0), Vector3(0, 0, 0.1), Vector3(2.0, 1.0, 0.0)}) {
    EXPECT_GT(best, ((rotation_exp(turn) * R).transpose() * C).trace());
  }
}

}  // namespace
}  // namespace pharos::host
