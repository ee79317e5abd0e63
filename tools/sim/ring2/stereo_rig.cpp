// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ring2/stereo_rig.hpp"

namespace pharos::sim {
namespace {

Matrix3 turn(double angle_rad, const Vector3& axis) {
  return Eigen::AngleAxis<double>(angle_rad, axis).toRotationMatrix();
}

}  // namespace

StereoRig symmetric_rig(double baseline_m, double toe_in_rad, double focal_px, std::int32_t width_px,
                        std::int32_t height_px) {
  StereoRig rig;
  for (std::size_t v = 0; v < 2; ++v) {
    const double side = v == 0 ? -1.0 : 1.0;
    rig[v] = {centred_lens(width_px, height_px, focal_px), turn(-side * toe_in_rad, Vector3::UnitY()),
              Vector3(side * 0.5 * baseline_m, 0.0, 0.0)};
  }
  return rig;
}

Vector3 facing_normal(double theta_rad, double gamma_rad) {
  return turn(theta_rad, Vector3::UnitX()) * turn(gamma_rad, Vector3::UnitY()) * -Vector3::UnitZ();
}

}  // namespace pharos::sim
