// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::sim {

float Texture::at(double s, double t) const {
  const double x = std::clamp(s * width - 0.5, 0.0, width - 1.0);
  const double y = std::clamp(t * height - 0.5, 0.0, height - 1.0);
  const auto left = std::min(static_cast<std::int32_t>(x), width - 2);
  const auto upper = std::min(static_cast<std::int32_t>(y), height - 2);
  const auto a = static_cast<float>(x - left), b = static_cast<float>(y - upper);
  const float above = cell(left, upper) * (1.0F - a) + cell(left + 1, upper) * a;
  const float below = cell(left, upper + 1) * (1.0F - a) + cell(left + 1, upper + 1) * a;
  return above * (1.0F - b) + below * b;
}

PanelScene moved(const PanelScene& scene, const Matrix3& R, const Vector3& t_m) {
  PanelScene out = scene;
  for (Panel& panel : out.panels) {
    panel.corner_m = R * panel.corner_m + t_m;
    panel.edge_s_m = R * panel.edge_s_m;
    panel.edge_t_m = R * panel.edge_t_m;
  }
  return out;
}

void add_box(PanelScene& scene, const Vector3& centre_m, const Vector3& half_m, int first_texture) {
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, across = (axis + 1) % 3, along = (axis + 2) % 3;
    Vector3 corner = centre_m - half_m;
    if (face % 2 == 1) corner[axis] += 2.0 * half_m[axis];
    Panel panel{corner, Vector3::Zero(), Vector3::Zero(), first_texture + face};
    panel.edge_s_m[across] = 2.0 * half_m[across];
    panel.edge_t_m[along] = 2.0 * half_m[along];
    scene.panels.push_back(panel);
  }
}

}  // namespace pharos::sim
