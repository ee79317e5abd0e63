// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/pose.hpp"
#include "tools/sim/povray/linear_image.hpp"
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// Directions (x/z, y/z) of the rays of a camera: `rays_per_side` squared a pixel, spread evenly over its area. The
/// lens distortion is inverted here, once a camera.
std::vector<Vector2> pixel_rays(const PinholeCamera& camera, int rays_per_side);

/// Light that a camera at T_scene_camera sees of panels: rays cast exactly through the (distorting) lens, as
/// POV-Ray cannot. Cost: some 20 ns a ray and panel that its pixel may show.
LinearImage cast_panels(const PanelScene& scene, const Lighting& lighting, const PinholeCamera& camera,
                        const std::vector<Vector2>& rays, int rays_per_side,
                        const Pose<frame::Rig, frame::Camera>& T_scene_camera);

/// Stars where the image is black: each fills the pixel that it falls into.
void draw_stars(LinearImage& image, const std::vector<Star>& stars, const PinholeCamera& camera,
                const Pose<frame::Rig, frame::Camera>& T_scene_camera);

}  // namespace pharos::sim
