// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/spin.hpp"

#include <gtest/gtest.h>

namespace pharos::pointing {
namespace {

TEST(Spin, JacobianIsThatOfCentralDifferences) {
  const Spin spin{Vector3(0.3, -0.8, 0.5).normalized(), Vector3(-0.2, 0.4, 0.9).normalized(), 0.07};
  const Vector3 normal = Vector3(0.9, 0.1, -0.4).normalized();
  for (const double seconds : {-60.0, -1.0, 0.0, 35.0}) {
    const Row5 J = spin_jacobian(spin, normal, seconds);
    for (int k = 0; k < 5; ++k) {
      Eigen::Matrix<double, 5, 1> step = Eigen::Matrix<double, 5, 1>::Zero();
      step[k] = 1e-6;
      const double slope =
          (normal.dot(spin.moved_by(step).at(seconds)) - normal.dot(spin.moved_by(-step).at(seconds))) / 2e-6;
      EXPECT_NEAR(J[k], slope, 1e-6) << k << " at " << seconds;
    }
  }
}

TEST(Spin, TurnsAboutItsAxis) {
  const Spin spin{Vector3::UnitX(), Vector3::UnitZ(), 0.1};
  EXPECT_LT((spin.at(5.0 * 3.14159265358979323846) - Vector3::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace pharos::pointing
