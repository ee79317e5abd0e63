// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pharos/base/units.hpp"

namespace pharos {
namespace {

Vector3 random_rotation_vector(std::mt19937& random, double max_angle_rad) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, max_angle_rad);
  const Vector3 axis(normal(random), normal(random), normal(random));
  return uniform(random) * axis.normalized();
}

TEST(Rotation, LogUndoesExpAtEveryScale) {
  std::mt19937 random(1);
  for (const double scale : {1e-12, 1e-8, 1e-4, 1e-3, 0.1, 1.0, kPi - 1e-6}) {
    for (int i = 0; i < 100; ++i) {
      const Vector3 phi = random_rotation_vector(random, scale);
      EXPECT_NEAR((rotation_log(rotation_exp(phi)) - phi).norm(), 0.0, 1e-9 * scale + 1e-15) << scale;
    }
  }
}

TEST(Rotation, ExpIsARotationAboutItsVector) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector3 phi = random_rotation_vector(random, 6.0);
    const Matrix3 R = rotation_exp(phi);
    EXPECT_NEAR((R.transpose() * R - Matrix3::Identity()).norm(), 0.0, 1e-14);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
    EXPECT_NEAR((R * phi - phi).norm(), 0.0, 1e-13);
    EXPECT_NEAR(R.trace(), 1.0 + 2.0 * std::cos(phi.norm()), 1e-13);
  }
}

TEST(Rotation, PositiveAngleAboutZTakesXToY) {
  EXPECT_NEAR((rotation_exp({0, 0, kPi / 2}) * Vector3::UnitX() - Vector3::UnitY()).norm(), 0.0, 1e-15);
}

TEST(PaperRotation, IsEquationFiveAsPrinted) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Vector3 phi = random_rotation_vector(random, 3.0);
    const double angle = phi.norm();
    const Vector3 e = phi / angle;
    const Matrix3 printed =
        std::cos(angle) * Matrix3::Identity() + (1 - std::cos(angle)) * e * e.transpose() - std::sin(angle) * skew(e);
    EXPECT_NEAR((paper_rotation(phi) - printed).norm(), 0.0, 1e-14);
  }
}

TEST(PaperRightJacobian, IsEquationNineAsPrinted) {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const Vector3 phi = random_rotation_vector(random, 3.0);
    const double a = phi.norm();
    const Vector3 e = phi / a;
    const Matrix3 printed = std::sin(a) / a * Matrix3::Identity() + (1 - std::sin(a) / a) * e * e.transpose() +
                            (std::cos(a) - 1) / a * skew(e);
    EXPECT_NEAR((paper_right_jacobian(phi) - printed).norm(), 0.0, 1e-13);
  }
}

TEST(PaperRightJacobian, IsTheDerivativeOfARotatedPointAsEquationEightSays) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const Vector3 phi = random_rotation_vector(random, 3.0);
    const Vector3 p_body(0.1, -0.2, 0.3);
    const Vector3 rotated = paper_rotation(phi) * p_body;
    const Matrix3 analytic = skew(rotated) * paper_right_jacobian(phi);
    const double step = 1e-6;
    for (int k = 0; k < 3; ++k) {
      Vector3 up = phi;
      Vector3 down = phi;
      up[k] += step;
      down[k] -= step;
      const Vector3 numeric = (paper_rotation(up) * p_body - paper_rotation(down) * p_body) / (2 * step);
      EXPECT_NEAR((analytic.col(k) - numeric).norm(), 0.0, 1e-9);
    }
  }
}

TEST(Quaternion, IsCanonicalAlsoForHalfTurns) {
  EXPECT_GE(canonical_quaternion(rotation_exp({0, 0, 3.5})).w(), 0.0);
  EXPECT_GT(canonical(Quaternion(0, -1, 0, 0)).x(), 0.0);
  EXPECT_GT(canonical(Quaternion(0, 0, -1, 0)).y(), 0.0);
}

TEST(Orthonormalised, RepairsDrift) {
  const Matrix3 R = rotation_exp({0.3, -0.7, 1.1});
  const Matrix3 drifted = R + 1e-5 * Matrix3::Ones();
  const Matrix3 repaired = orthonormalised(drifted);
  EXPECT_NEAR((repaired.transpose() * repaired - Matrix3::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR((repaired - R).norm(), 0.0, 5e-5);
}

}  // namespace
}  // namespace pharos
