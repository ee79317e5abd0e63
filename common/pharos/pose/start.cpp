// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/start.hpp"

#include "pharos/pose/attitude_grid.hpp"
#include "pharos/pose/dlt.hpp"
#include "pharos/pose/homography.hpp"
#include "pharos/pose/linearise.hpp"
#include "pharos/pose/p3p.hpp"
#include "pharos/pose/rpnp.hpp"

namespace pharos::pose {
namespace {

// A DLT pose must reproject within this fraction of the target's apparent size (rms against rms): a wrong one, frequent
// on small targets, misses by about the whole of it.
constexpr double kDltGate = 0.1;

double apparent_square(const RaySet& set) {
  Vector3 mean = Vector3::Zero();
  for (int k = 0; k < set.count; ++k) mean += set.ray[static_cast<std::size_t>(k)] / set.count;
  double sum = 0.0;
  for (int k = 0; k < set.count; ++k) sum += (set.ray[static_cast<std::size_t>(k)] - mean).squaredNorm();
  return sum;
}

StartPoses gated_dlt(const ObservationTable& table, const RaySet& set) {
  StartPoses poses = dlt(set);
  const bool good =
      !poses.empty() && cost_of(table, poses[0], Residual::kAngle) < kDltGate * kDltGate * apparent_square(set);
  if (!good) poses.clear();
  return poses;
}

StartPoses by_method(const ObservationTable& table, const RaySet& set, Start method) {
  switch (method) {
    case Start::kRpnp:
      return rpnp(set);
    case Start::kDlt:
      return gated_dlt(table, set);
    case Start::kHomography:
      return homography(set);
    case Start::kAuto:
    case Start::kP3p:
      break;
  }
  return {};
}

}  // namespace

StartPoses start_poses(const ObservationTable& table, Start method) {
  const RaySet set = rays_of(table);
  if (set.count < 3) return attitude_grid(table);
  const StartPoses poses = by_method(table, set, method);
  return poses.empty() ? p3p(set, wide_triplet(set)) : poses;
}

}  // namespace pharos::pose
