// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/attitude_grid.hpp"

#include <cmath>

#include "pharos/geometry/packed_symmetric.hpp"
#include "pharos/pose/linearise.hpp"

namespace pharos::pose {
namespace {

// Quaternions whose components are -1, 0 or 1, one of each pair of opposites: 40 rotations at most 42 deg from any.
constexpr int kCodes = 81;

bool attitude_of(int code, Quaternion& attitude) {
  const int w = code % 3 - 1, x = code / 3 % 3 - 1, y = code / 9 % 3 - 1, z = code / 27 - 1;
  const int first = w != 0 ? w : x != 0 ? x : y != 0 ? y : z;
  if (first <= 0) return false;
  attitude = Quaternion(w, x, y, z).normalized();
  return true;
}

// Translation that brings the rotated sensors nearest to their planes.
Vector3 translation_for(const ObservationTable& s, const Matrix3& R) {
  PackedSymmetric<3> normal;
  std::array<double, 3> right{};
  for (int i = 0; i < s.count; ++i) {
    const Vector3 q = R * s.body(i);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      if (!s.seen(i, axis)) continue;
      const ObservationTable::AxisColumns& c = s.axis[static_cast<std::size_t>(index_of(axis))];
      Vector3 plane = Vector3::Zero();
      plane[index_of(axis)] = c.sine[static_cast<std::size_t>(i)];
      plane.z() = -c.cosine[static_cast<std::size_t>(i)];
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b <= a; ++b) normal(a, b) += plane[static_cast<int>(a)] * plane[static_cast<int>(b)];
        right[a] -= plane[static_cast<int>(a)] * plane.dot(q);
      }
    }
  }
  const std::array<double, 3> t = Factorisation<3>(normal).solve(right);
  return {t[0], t[1], t[2]};
}

}  // namespace

StartPoses attitude_grid(const ObservationTable& table) {
  StartPoses poses;
  std::array<double, StartPoses::kCapacity> costs{};
  for (int code = 0; code < kCodes; ++code) {
    Quaternion attitude;
    if (!attitude_of(code, attitude)) continue;
    LighthouseFromBody pose;
    pose.R = attitude.toRotationMatrix();
    pose.t = translation_for(table, pose.R);
    const double cost = cost_of(table, pose, Residual::kAngle);
    if (!(pose.t.z() > 0.0) || !pose.is_finite() || !(cost < 1e300)) continue;
    if (poses.full() && costs[poses.size() - 1] <= cost) continue;
    if (!poses.full()) poses.push_back(pose);
    std::size_t place = poses.size() - 1;
    for (; place > 0 && costs[place - 1] > cost; --place) {
      costs[place] = costs[place - 1];
      poses[place] = poses[place - 1];
    }
    costs[place] = cost;
    poses[place] = pose;
  }
  return poses;
}

}  // namespace pharos::pose
