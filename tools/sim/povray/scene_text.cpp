// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/povray/scene_text.hpp"

#include "host/support/exact_number.hpp"

namespace pharos::sim {

std::string povray_vector(const Vector3& vector) {
  return '<' + host::exact_number(vector.x()) + ", " + host::exact_number(-vector.y()) + ", " +
         host::exact_number(vector.z()) + '>';
}

std::string povray_camera(const Lens& lens, const Matrix3& R_world_camera, const Vector3& t_world_camera_m) {
  // The ray of image position (s, t), each -1/2 to 1/2 with t upwards, is direction + s right + t up. The direction is
  // that of the image's middle, (width - 1) / 2; it need not be perpendicular to the other two.
  const double middle_u_px = 0.5 * (lens.width_px - 1);
  const double middle_v_px = 0.5 * (lens.height_px - 1);
  const Vector3 direction((middle_u_px - lens.cx_px) / lens.fx_px, (middle_v_px - lens.cy_px) / lens.fy_px, 1.0);
  const Vector3 right(lens.width_px / lens.fx_px, 0.0, 0.0);
  const Vector3 up(0.0, -lens.height_px / lens.fy_px, 0.0);
  return "camera {\n  perspective\n  location " + povray_vector(t_world_camera_m) + "\n  direction " +
         povray_vector(R_world_camera * direction) + "\n  right " + povray_vector(R_world_camera * right) + "\n  up " +
         povray_vector(R_world_camera * up) + "\n}\n";
}

std::string povray_preamble() {
  return "#version 3.7;\nglobal_settings { assumed_gamma 1.0 ambient_light rgb 0 max_trace_level 8 }\n";
}

}  // namespace pharos::sim
