// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/dlt.hpp"

#include <cmath>

#include "pharos/pose/linear_pose.hpp"

namespace pharos::pose {
namespace {

// Centre and scale that normalise the points to unit size: conditions the equations.
struct Frame {
  Vector3 centre = Vector3::Zero();
  double size_m = 0.0;
};

Frame frame_of(const RaySet& set) {
  Frame frame;
  const auto count = static_cast<std::size_t>(set.count);
  for (std::size_t k = 0; k < count; ++k) frame.centre += set.body[k] / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k) frame.size_m += (set.body[k] - frame.centre).squaredNorm();
  frame.size_m = std::sqrt(frame.size_m / static_cast<double>(count));
  return frame;
}

PackedSymmetric<12> equations(const RaySet& set, const Frame& frame) {
  PackedSymmetric<12> sum;
  for (std::size_t k = 0; k < static_cast<std::size_t>(set.count); ++k) {
    const Vector3 b = (set.body[k] - frame.centre) / frame.size_m;
    const std::array<double, 4> point{b.x(), b.y(), b.z(), 1.0};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      std::array<double, 12> row{};
      for (std::size_t i = 0; i < 4; ++i) {
        row[4 * axis + i] = set.ray[k].z() * point[i];
        row[8 + i] = -set.ray[k][static_cast<int>(axis)] * point[i];
      }
      for (std::size_t i = 0; i < 12; ++i) {
        for (std::size_t j = 0; j <= i; ++j) sum(i, j) += row[i] * row[j];
      }
    }
  }
  return sum;
}

}  // namespace

StartPoses dlt(const RaySet& set) {
  StartPoses poses;
  if (set.count < kDltSensors) return poses;
  const Frame frame = frame_of(set);
  const std::array<double, 12> m = smallest_eigenvector(equations(set, frame));
  Matrix3 M;
  M << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  Vector3 last(m[3], m[7], m[11]);
  if (last.z() < 0.0) {  // the centre lies ahead of the station
    M = -M;
    last = -last;
  }
  const double determinant = M.determinant();
  if (!(determinant > 0.0)) return poses;
  LighthouseFromBody pose;
  pose.R = polar_rotation(M);
  pose.t = last * (frame.size_m / std::cbrt(determinant)) - pose.R * frame.centre;
  if (pose.is_finite()) poses.push_back(pose);
  return poses;
}

}  // namespace pharos::pose
