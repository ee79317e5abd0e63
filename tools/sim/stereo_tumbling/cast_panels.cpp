// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/cast_panels.hpp"

#include <algorithm>
#include <cmath>

#include "tools/sim/render/primitives.hpp"

namespace pharos::sim {
namespace {

// A panel in the camera's frame.
struct CameraPanel {
  PlaneCoordinates plane;
  const Texture* texture = nullptr;
  std::int32_t first_u = 0, last_u = 0, first_v = 0, last_v = 0;  // pixels that may show it
};

// All pixels where a corner stands beside or behind the camera.
void bound(const Lens& lens, const Vector3& corner, const Vector3& edge_s, const Vector3& edge_t, CameraPanel& out) {
  out.first_u = out.first_v = 0;
  out.last_u = lens.width_px - 1;
  out.last_v = lens.height_px - 1;
  Vector2 low(1e9, 1e9), high(-1e9, -1e9);
  for (int k = 0; k < 4; ++k) {
    const Vector3 p = corner + (k % 2) * edge_s + (k / 2) * edge_t;
    if (p.z() < 0.1 || std::abs(p.x()) > 1.5 * p.z() || std::abs(p.y()) > 1.5 * p.z()) return;
    const Vector2 pixel = pixel_of(lens, p);
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  // Distortion bends edges outwards by less than this.
  const double margin = has_distortion(lens) ? 40.0 : 2.0;
  out.first_u = std::max(out.first_u, static_cast<std::int32_t>(low.x() - margin));
  out.first_v = std::max(out.first_v, static_cast<std::int32_t>(low.y() - margin));
  out.last_u = std::min(out.last_u, static_cast<std::int32_t>(high.x() + margin));
  out.last_v = std::min(out.last_v, static_cast<std::int32_t>(high.y() + margin));
}

CameraPanel seen_from(const Panel& panel, const PanelScene& scene, const Lens& lens,
                      const Pose<frame::Camera, frame::Rig>& T_camera_scene) {
  const Vector3 corner = T_camera_scene * panel.corner_m;
  const Vector3 s = T_camera_scene.R * panel.edge_s_m, t = T_camera_scene.R * panel.edge_t_m;
  CameraPanel out{PlaneCoordinates(corner, s, t), &scene.textures[static_cast<std::size_t>(panel.texture)], 0, 0, 0, 0};
  bound(lens, corner, s, t, out);
  return out;
}

struct Hit {
  double depth = kNever;
  const CameraPanel* panel = nullptr;
  double s = 0.0, t = 0.0;
};

Hit nearest(const std::vector<const CameraPanel*>& panels, std::int32_t u, const Vector3& ray) {
  Hit hit;
  for (const CameraPanel* panel : panels) {
    if (u < panel->first_u || u > panel->last_u) continue;
    const double depth = panel->plane.depth(ray);
    if (!(depth > 0.05 && depth < hit.depth)) continue;
    const double s = panel->plane.s(ray, depth);
    if (!(s >= 0.0 && s <= 1.0)) continue;
    const double t = panel->plane.t(ray, depth);
    if (t >= 0.0 && t <= 1.0) hit = {depth, panel, s, t};
  }
  return hit;
}

double light_of(const Hit& hit, const Vector3& ray, const Lighting& lighting, const Vector3& lamp_camera_m) {
  if (hit.panel == nullptr) return 0.0;
  const Vector3 to_lamp = (lamp_camera_m - hit.depth * ray).normalized();
  const double lit = lighting.ambient + lighting.diffuse * std::abs(hit.panel->plane.normal().dot(to_lamp));
  return lit * static_cast<double>(hit.panel->texture->at(hit.s, hit.t));
}

}  // namespace

void draw_stars(LinearImage& image, const std::vector<Star>& stars, const Lens& lens,
                const Pose<frame::Rig, frame::Camera>& T_scene_camera) {
  for (const Star& star : stars) {
    const Vector3 d = T_scene_camera.R.transpose() * star.direction;
    if (d.z() <= 0.1) continue;
    const Vector2 pixel = pixel_of(lens, d);
    const auto u = static_cast<std::int32_t>(std::lround(pixel.x()));
    const auto v = static_cast<std::int32_t>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= lens.width_px || v >= lens.height_px) continue;
    if (image.at(u, v) <= 0.0F) image.at(u, v) = static_cast<float>(star.light);
  }
}

LinearImage cast_panels(const PanelScene& scene, const Lighting& lighting, const Lens& lens, const RayGrid& rays,
                        int rays_per_side, const Pose<frame::Rig, frame::Camera>& T_scene_camera) {
  const Pose<frame::Camera, frame::Rig> T_camera_scene = T_scene_camera.inverse();
  std::vector<CameraPanel> panels;
  panels.reserve(scene.panels.size());
  for (const Panel& panel : scene.panels) panels.push_back(seen_from(panel, scene, lens, T_camera_scene));
  const Vector3 lamp = T_camera_scene * lighting.lamp_m;
  LinearImage image{lens.width_px, lens.height_px, {}};
  image.light.assign(static_cast<std::size_t>(lens.width_px) * static_cast<std::size_t>(lens.height_px), 0.0F);
  std::vector<const CameraPanel*> row;
  for (std::int32_t v = 0; v < lens.height_px; ++v) {
    row.clear();
    for (const CameraPanel& panel : panels) {
      if (v >= panel.first_v && v <= panel.last_v) row.push_back(&panel);
    }
    if (row.empty()) continue;
    for (std::int32_t u = 0; u < lens.width_px; ++u) {
      double sum = 0.0;
      int hits = 0;
      for (int down = 0; down < rays_per_side; ++down) {
        const Vector2* ray = rays.row_begin(v * rays_per_side + down, u * rays_per_side);
        for (int across = 0; across < rays_per_side; ++across, ++ray) {
          const Vector3 direction(ray->x(), ray->y(), 1.0);
          const Hit hit = nearest(row, u, direction);
          hits += hit.panel != nullptr ? 1 : 0;
          sum += light_of(hit, direction, lighting, lamp);
        }
      }
      if (hits > 0) image.at(u, v) = static_cast<float>(sum / (rays_per_side * rays_per_side));
    }
  }
  return image;
}

}  // namespace pharos::sim
