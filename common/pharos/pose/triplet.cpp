// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/triplet.hpp"

namespace pharos::pose {
namespace {

int farthest_from(const RaySet& set, const Vector3& point) {
  int best = 0;
  double best_square = -1.0;
  for (int i = 0; i < set.count; ++i) {
    const double square = (set.ray[static_cast<std::size_t>(i)] - point).squaredNorm();
    if (square > best_square) {
      best = i;
      best_square = square;
    }
  }
  return best;
}

}  // namespace

double spread_of(const RaySet& set, const Triplet& triplet) {
  const Vector3& a = set.ray[static_cast<std::size_t>(triplet[0])];
  const Vector3 b = set.ray[static_cast<std::size_t>(triplet[1])] - a;
  const Vector3 c = set.ray[static_cast<std::size_t>(triplet[2])] - a;
  return b.cross(c).squaredNorm();
}

Triplet wide_triplet(const RaySet& set) {
  Vector3 mean = Vector3::Zero();
  for (int i = 0; i < set.count; ++i) mean += set.ray[static_cast<std::size_t>(i)];
  mean /= static_cast<double>(set.count);
  Triplet best{farthest_from(set, mean), 0, 0};
  best[1] = farthest_from(set, set.ray[static_cast<std::size_t>(best[0])]);
  double best_spread = -1.0;
  for (int i = 0; i < set.count; ++i) {
    const double spread = spread_of(set, {best[0], best[1], i});
    if (i != best[0] && i != best[1] && spread > best_spread) {
      best[2] = i;
      best_spread = spread;
    }
  }
  return best;
}

}  // namespace pharos::pose
