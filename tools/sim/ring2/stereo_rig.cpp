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
    StereoCamera& camera = rig[v];
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.fx_px = camera.fy_px = focal_px;
    camera.cx_px = 0.5 * (width_px - 1);
    camera.cy_px = 0.5 * (height_px - 1);
    camera.t_rig_camera_m = Vector3(side * 0.5 * baseline_m, 0.0, 0.0);
    camera.R_rig_camera = turn(-side * toe_in_rad, Vector3::UnitY());
  }
  return rig;
}

Vector3 facing_normal(double theta_rad, double gamma_rad) {
  return turn(theta_rad, Vector3::UnitX()) * turn(gamma_rad, Vector3::UnitY()) * -Vector3::UnitZ();
}

}  // namespace pharos::sim
