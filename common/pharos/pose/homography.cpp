// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/homography.hpp"

#include <cmath>

#include "pharos/pose/linear_pose.hpp"
#include "pharos/pose/plane_fit.hpp"

namespace pharos::pose {
namespace {

constexpr int kMinRays = 4;

struct PlaneFrame {
  Vector3 centre;
  Matrix3 axes;  // columns: two in the plane, the normal
  double thickness_m;
};

PlaneFrame plane_of(const RaySet& set) {
  Vector3 centre = Vector3::Zero();
  for (int k = 0; k < set.count; ++k) centre += set.body[static_cast<std::size_t>(k)] / set.count;
  PlaneFit fit(centre);
  for (int k = 0; k < set.count; ++k) fit.add(set.body[static_cast<std::size_t>(k)]);
  PlaneFrame frame{centre, Matrix3::Identity(), 0.0};
  frame.axes.col(2) = fit.normal();
  frame.axes.col(0) = frame.axes.col(2).unitOrthogonal();
  frame.axes.col(1) = frame.axes.col(2).cross(frame.axes.col(0));
  frame.thickness_m = fit.thickness_m(frame.axes.col(2));
  return frame;
}

double size_of(const RaySet& set, const PlaneFrame& frame) {
  double square = 0.0;
  for (int k = 0; k < set.count; ++k) square += (set.body[static_cast<std::size_t>(k)] - frame.centre).squaredNorm();
  return std::sqrt(square / set.count);
}

PackedSymmetric<9> equations(const RaySet& set, const PlaneFrame& frame, double size_m) {
  PackedSymmetric<9> sum;
  for (std::size_t k = 0; k < static_cast<std::size_t>(set.count); ++k) {
    const Vector3 b = frame.axes.transpose() * (set.body[k] - frame.centre) / size_m;
    const std::array<double, 3> point{b.x(), b.y(), 1.0};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      std::array<double, 9> row{};
      for (std::size_t i = 0; i < 3; ++i) {
        row[3 * axis + i] = set.ray[k].z() * point[i];
        row[6 + i] = -set.ray[k][static_cast<int>(axis)] * point[i];
      }
      for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t j = 0; j <= i; ++j) sum(i, j) += row[i] * row[j];
      }
    }
  }
  return sum;
}

}  // namespace

StartPoses homography(const RaySet& set) {
  StartPoses poses;
  if (set.count < kMinRays) return poses;
  const PlaneFrame frame = plane_of(set);
  if (frame.thickness_m > kCoplanarThickness_m) return poses;
  const double size_m = size_of(set, frame);
  const std::array<double, 9> h = smallest_eigenvector(equations(set, frame, size_m));
  const double sign = h[8] < 0.0 ? -1.0 : 1.0;  // the centre lies ahead of the station
  const Vector3 first = sign * Vector3(h[0], h[3], h[6]), second = sign * Vector3(h[1], h[4], h[7]);
  Matrix3 M;
  M.col(0) = first;
  M.col(1) = second;
  M.col(2) = first.cross(second).normalized() * std::sqrt(first.norm() * second.norm());
  const double scale = std::sqrt(first.norm() * second.norm());
  LighthouseFromBody pose;
  pose.R = polar_rotation(M) * frame.axes.transpose();
  pose.t = sign * Vector3(h[2], h[5], h[8]) * (size_m / scale) - pose.R * frame.centre;
  if (pose.is_finite()) poses.push_back(pose);
  return poses;
}

}  // namespace pharos::pose
