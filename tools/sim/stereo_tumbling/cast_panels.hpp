// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pharos/geometry/pose.hpp"
#include "tools/sim/optics/linear_image.hpp"
#include "tools/sim/optics/ray_grid.hpp"
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// Light that a camera at T_scene_camera sees of panels: rays cast exactly through the (distorting) lens, as
/// POV-Ray cannot. `rays` is RayGrid::inside_pixels(lens, rays_per_side). Cost: some 20 ns a ray and panel that its
/// part of the image may show.
LinearImage cast_panels(const PanelScene& scene, const Lighting& lighting, const Lens& lens, const RayGrid& rays,
                        int rays_per_side, const Pose<frame::Rig, frame::Camera>& T_scene_camera);

/// Stars where the image is black: each fills the pixel that it falls into.
void draw_stars(LinearImage& image, const std::vector<Star>& stars, const Lens& lens,
                const Pose<frame::Rig, frame::Camera>& T_scene_camera);

}  // namespace pharos::sim
