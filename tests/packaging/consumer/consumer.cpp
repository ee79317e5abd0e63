// SPDX-License-Identifier: Apache-2.0
// Solves a pose from angles that it makes itself and compares.
#include <cmath>
#include <cstdio>

#include "pharos/pose/solve.hpp"

int main() {
  using namespace pharos;
  const double places_m[][3] = {{0.05, 0.0, 0.0},    {-0.05, 0.01, 0.0},  {0.0, 0.06, 0.02},
                                {0.01, -0.05, 0.03}, {0.02, 0.03, -0.04}, {-0.03, -0.02, 0.05}};
  const Vector3 t_m(0.2, -0.1, 2.0);  // the body's axes are the lighthouse's
  Target target;
  pose::Observations angles;
  std::uint8_t number = 0;
  for (const auto& place : places_m) {
    const Vector3 body_m(place[0], place[1], place[2]);
    target.push_back({number, body_m, Vector3::Zero()});
    const Vector3 p_m = body_m + t_m;
    angles.push_back({number, Axis::kX, std::atan2(p_m.z(), p_m.x())});
    angles.push_back({number, Axis::kY, std::atan2(p_m.z(), p_m.y())});
    ++number;
  }
  const auto solution = pose::solve(target, angles, pose::SolveOptions{});
  if (!solution) {
    std::printf("refused: %s\n", pose::name_of(solution.error()));
    return 1;
  }
  const auto& pose = solution->estimate.pose;
  const double off_m = (pose.t - t_m).norm();
  const double off_rad = (pose.R - Eigen::Matrix3d::Identity()).norm();
  std::printf("off by %g m, %g rad\n", off_m, off_rad);
  return off_m < 1e-6 && off_rad < 1e-6 ? 0 : 1;
}
