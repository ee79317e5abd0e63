// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// A grey picture that is painted on panels: albedo 0 to 1 at the centres of its cells, row by row.
struct Texture {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<float> albedo;

  float cell(std::int32_t s, std::int32_t t) const {
    return albedo[static_cast<std::size_t>(t) * static_cast<std::size_t>(width) + static_cast<std::size_t>(s)];
  }
  /// Linear between cells; s, t in [0, 1].
  float at(double s, double t) const;
};

/// A flat parallelogram: corner + s edge_s + t edge_t with s, t in [0, 1]. Seen and lit from both sides alike.
struct Panel {
  Vector3 corner_m = Vector3::Zero();
  Vector3 edge_s_m = Vector3::UnitX();
  Vector3 edge_t_m = Vector3::UnitY();
  int texture = 0;
};

/// A point of light at infinity; covers about a pixel.
struct Star {
  Vector3 direction = Vector3::UnitZ();
  double light = 0.5;
};

/// What a scene is lit by: light = albedo (ambient + diffuse |normal . direction to the lamp|). No shadows.
struct Lighting {
  double ambient = 0.1;
  double diffuse = 0.9;
  Vector3 lamp_m = Vector3::Zero();
};

/// Textured panels in a frame of their own, x right, y down, z ahead.
struct PanelScene {
  std::vector<Texture> textures;
  std::vector<Panel> panels;
};

/// The scene moved: p' = R p + t.
PanelScene moved(const PanelScene& scene, const Matrix3& R, const Vector3& t_m);

/// The six faces of a box about `centre_m`, half sides given; face k has texture first_texture + k.
void add_box(PanelScene& scene, const Vector3& centre_m, const Vector3& half_m, int first_texture);

}  // namespace pharos::sim
