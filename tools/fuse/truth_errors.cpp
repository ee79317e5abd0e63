// SPDX-License-Identifier: Apache-2.0
#include "tools/fuse/truth_errors.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "pharos/base/units.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "tools/evaluate/trajectory_file.hpp"

namespace pharos::tools {
TruthErrors::TruthErrors(const std::string& path)
    : truth_(evaluate::read_trajectory<evaluate::TruthPose>(path, evaluate::TrajectoryChoice{}).samples) {}

std::optional<StateError> TruthErrors::add(const fusion::TargetState& state) {
  if (!state.valid) return std::nullopt;
  const auto truth = evaluate::pose_at(truth_, static_cast<double>(state.time_ns) * 1e-9, kMaxTruthGap_s);
  if (!truth) return std::nullopt;
  const fusion::TargetPose expected{truth->pose.R, truth->pose.t};
  const Vector6 delta = pose_difference(expected, state.kinematics.pose);
  const Matrix6 covariance = state.covariance.topLeftCorner<6, 6>();
  StateError out;
  out.rotation_rad = delta.head<3>().norm();
  out.position_m = delta.tail<3>().norm();
  out.nees = mahalanobis_squared<6>(delta, covariance) / 6.0;
  const fusion::ProtectionLevel& level = state.protection;
  out.outside = (level.position_available && out.position_m > level.position_m) ||
                (level.rotation_available && out.rotation_rad > level.rotation_rad);
  ++compared_;
  levels_ += level.position_available || level.rotation_available ? 1 : 0;
  outside_ += out.outside ? 1 : 0;
  rotation_rad2_ += out.rotation_rad * out.rotation_rad;
  position_m2_ += out.position_m * out.position_m;
  nees_ += out.nees;
  return out;
}

std::string TruthErrors::summary() const {
  if (compared_ == 0) return "no state has a truth at its time";
  const double count = static_cast<double>(compared_);
  std::array<char, 200> text{};
  std::snprintf(
      text.data(), text.size(),
      "%zu states beside the truth: RMS %.3f deg, %.2f mm; NEES of the pose %.2f (1 is expected); truth outside "
      "of the protection level in %zu of %zu",
      compared_, std::sqrt(rotation_rad2_ / count) * kDegPerRad, std::sqrt(position_m2_ / count) * kMmPerM,
      nees_ / count, outside_, levels_);
  return text.data();
}

}  // namespace pharos::tools
