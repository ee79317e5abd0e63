// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/polynomial.hpp"

#include <gtest/gtest.h>

#include "pharos/pose/linear_pose.hpp"

namespace pharos::pose {
namespace {

TEST(Polynomial, FindsAllRootsOfASeventhDegreeProduct) {
  const std::array<double, 7> roots{-2.0, -0.5, 0.1, 0.11, 0.7, 3.0, 9.0};
  Polynomial<7> p{1.0};
  for (std::size_t degree = 0; degree < roots.size(); ++degree) {
    for (std::size_t k = degree + 2; k-- > 1;) p[k] = p[k - 1] - roots[degree] * p[k];
    p[0] *= -roots[degree];
  }
  const RealRoots<7> found = real_roots<7>(p, -3.0, 10.0);
  ASSERT_EQ(found.count, roots.size());
  for (std::size_t k = 0; k < roots.size(); ++k) EXPECT_NEAR(found.root[k], roots[k], 1e-9);
}

TEST(Polynomial, FindsNoRootWhereThereIsNone) {
  EXPECT_EQ(real_roots<2>({1.0, 0.0, 1.0}, -10.0, 10.0).count, 0u);
  EXPECT_EQ(real_roots<3>({-8.0, 0.0, 0.0, 1.0}, 3.0, 10.0).count, 0u);
}

TEST(SmallestEigenvector, SolvesAnExactlySingularMatrix) {
  PackedSymmetric<3> m;  // v v^T + w w^T, null vector v x w
  const Vector3 v(1.0, 2.0, -1.0), w(0.5, 0.0, 3.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const int r = static_cast<int>(i), c = static_cast<int>(j);
      m(i, j) = v[r] * v[c] + w[r] * w[c];
    }
  }
  const std::array<double, 3> x = smallest_eigenvector(m);
  EXPECT_NEAR(std::fabs(Vector3(x[0], x[1], x[2]).dot(v.cross(w).normalized())), 1.0, 1e-9);
}

TEST(PolarRotation, TakesScaleAndShearOff) {
  const Matrix3 R = Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  Matrix3 stretch;
  stretch << 1.2, 0.1, 0.0, 0.1, 0.9, -0.05, 0.0, -0.05, 1.0;
  EXPECT_NEAR((polar_rotation(3.0 * R * stretch) - R).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace pharos::pose
