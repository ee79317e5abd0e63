// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "pharos/geometry/types.hpp"
#include "tools/sim/optics/lens.hpp"
#include "tools/sim/optics/linear_image.hpp"

namespace pharos::sim {

/// Reflection of light by a surface.
struct Material {
  double albedo = 0.5;
  double gloss = 0.0;  ///< light of a specular highlight, in addition to the albedo's
  double bumps = 0.0;  ///< tilt of the normal by wrinkles, rad
  double bump_size_m = 0.1;
  /// Cells: brighter or darker lines around each, of a box's faces; 0: none.
  Vector2 cell_m = Vector2::Zero();
  double line_m = 0.0, line_albedo = 0.0;
  /// Which random pattern of paint and wrinkles a surface has, each face of a box another; equal numbers on equal
  /// shapes look alike. 0: one pattern for all, wrinkles only.
  std::uint32_t pattern = 0;
  double paint_contrast = 0.0;  ///< of stains, as large as the wrinkles, and of whole cells: +- this part of the albedo
};

// Shapes in their own frame.
struct SolidBox {
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();
};
struct FlatRing {  ///< at z = 0, seen from both sides; a disc where the inner radius is 0
  double inner_m = 0.0, outer_m = 0.0;
};
struct ConeShell {  ///< around z from z = 0 to `length_m`, seen from both sides; a tube where the radii are equal
  double first_m = 0.0, last_m = 0.0, length_m = 0.0;
};
struct Dish {  ///< part of a sphere about the origin above z = `from_m`, seen from both sides
  double radius_m = 0.0, from_m = 0.0;
};

/// A shape at its place: p_scene = R p_shape + t.
struct Solid {
  std::variant<SolidBox, FlatRing, ConeShell, Dish> shape;
  Material material;
  Matrix3 R = Matrix3::Identity();
  Vector3 t_m = Vector3::Zero();
};

struct SolidScene {
  std::vector<Solid> solids;
  Vector3 to_sun = Vector3::UnitZ();  ///< unit
  double fill = 0.05;                 ///< of the sun's light, from the camera's side, without shadows
  double sun_radius_rad = 0.0;        ///< of the sun or lamp as seen from the scene: soft edges of shadows
};

/// The scene's light in a camera with p_scene = R p_camera + t: hard shadows, `rays` places a pixel where surfaces or
/// their light change, one elsewhere. Not blurred, nothing of a sensor. About 0.3 s for 1280x1024.
LinearImage solid_image(const SolidScene& scene, const Lens& lens, const Matrix3& R_scene_camera,
                        const Vector3& t_scene_camera_m, int rays = 32);

}  // namespace pharos::sim
