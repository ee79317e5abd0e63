// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/mahalanobis.hpp"

#include "pharos/geometry/packed_symmetric.hpp"

namespace pharos::motion {

double mahalanobis_squared(const LighthouseFromBody& a, const LighthouseFromBody& b, const Matrix6& allowed) {
  PackedSymmetric<6> packed;
  std::array<double, 6> apart;
  const Vector6 d = pose_difference(a, b);
  for (std::size_t i = 0; i < 6; ++i) {
    apart[i] = d[static_cast<int>(i)];
    for (std::size_t j = 0; j <= i; ++j) packed(i, j) = allowed(static_cast<int>(i), static_cast<int>(j));
  }
  const std::array<double, 6> solved = Factorisation<6>(packed).solve(apart);
  double square = 0.0;
  for (std::size_t i = 0; i < 6; ++i) square += apart[i] * solved[i];
  return square;
}

}  // namespace pharos::motion
