// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/motion_prior.hpp"

#include <cmath>
#include <numbers>

namespace pharos::slam {
namespace {

constexpr double kFaster = 2.0;
constexpr double kUnforeseen_rad = std::numbers::pi / 6.0;

}  // namespace

bool can_have_come_to(const MotionPrior& prior, const CameraFromTarget& found, double elapsed_s) {
  const double turned_rad = rotation_angle_between(found.R, prior.last.R);
  if (!(turned_rad <= kFaster * prior.rate_rad_s * elapsed_s + kUnforeseen_rad)) return false;
  const Vector3 before = prior.last * prior.centre_m;
  const double moved_m = (found * prior.centre_m - before).norm();
  return moved_m <= kFaster * prior.speed_m_s * elapsed_s + kUnforeseen_rad * before.norm();
}

}  // namespace pharos::slam
