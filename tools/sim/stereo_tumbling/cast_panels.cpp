// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/cast_panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos::sim {
namespace {

// A ray's crossing with a panel in the camera's frame: depth = offset / (normal . ray), s and t by dual vectors.
struct CameraPanel {
  Vector3 normal, dual_s, dual_t;
  double offset = 0.0, s0 = 0.0, t0 = 0.0;
  const Texture* texture = nullptr;
  std::int32_t first_u = 0, last_u = 0, first_v = 0, last_v = 0;  // pixels that may show it
};

// All pixels where a corner stands beside or behind the camera.
void bound(const Panel& panel, const PinholeCamera& camera, const Vector3& corner, const Matrix3& R, CameraPanel& out) {
  out.first_u = out.first_v = 0;
  out.last_u = camera.width_px - 1;
  out.last_v = camera.height_px - 1;
  Vector2 low(1e9, 1e9), high(-1e9, -1e9);
  for (int k = 0; k < 4; ++k) {
    const Vector3 p = corner + (k % 2) * (R * panel.edge_s_m) + (k / 2) * (R * panel.edge_t_m);
    if (p.z() < 0.1 || std::abs(p.x()) > 1.5 * p.z() || std::abs(p.y()) > 1.5 * p.z()) return;
    const Vector2 pixel = distort(camera, Vector2(p.x() / p.z(), p.y() / p.z()));
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  // Distortion bends edges outwards by less than this.
  const double margin = camera.distortion == std::array<double, 5>{} ? 2.0 : 40.0;
  out.first_u = std::max(out.first_u, static_cast<std::int32_t>(low.x() - margin));
  out.first_v = std::max(out.first_v, static_cast<std::int32_t>(low.y() - margin));
  out.last_u = std::min(out.last_u, static_cast<std::int32_t>(high.x() + margin));
  out.last_v = std::min(out.last_v, static_cast<std::int32_t>(high.y() + margin));
}

CameraPanel seen_from(const Panel& panel, const PanelScene& scene, const PinholeCamera& camera,
                      const Pose<frame::Camera, frame::Rig>& T_camera_scene) {
  CameraPanel out;
  const Vector3 corner = T_camera_scene * panel.corner_m;
  const Vector3 s = T_camera_scene.R * panel.edge_s_m, t = T_camera_scene.R * panel.edge_t_m;
  out.normal = s.cross(t).normalized();
  const Vector3 across_s = t.cross(out.normal), across_t = out.normal.cross(s);
  out.dual_s = across_s / across_s.dot(s);
  out.dual_t = across_t / across_t.dot(t);
  out.offset = out.normal.dot(corner);
  out.s0 = -out.dual_s.dot(corner);
  out.t0 = -out.dual_t.dot(corner);
  out.texture = &scene.textures[static_cast<std::size_t>(panel.texture)];
  bound(panel, camera, corner, T_camera_scene.R, out);
  return out;
}

struct Hit {
  double depth = std::numeric_limits<double>::infinity();
  const CameraPanel* panel = nullptr;
  double s = 0.0, t = 0.0;
};

Hit nearest(const std::vector<const CameraPanel*>& panels, std::int32_t u, const Vector3& ray) {
  Hit hit;
  for (const CameraPanel* panel : panels) {
    if (u < panel->first_u || u > panel->last_u) continue;
    const double depth = panel->offset / panel->normal.dot(ray);
    if (!(depth > 0.05 && depth < hit.depth)) continue;
    const double s = depth * panel->dual_s.dot(ray) + panel->s0;
    if (!(s >= 0.0 && s <= 1.0)) continue;
    const double t = depth * panel->dual_t.dot(ray) + panel->t0;
    if (t >= 0.0 && t <= 1.0) hit = {depth, panel, s, t};
  }
  return hit;
}

double light_of(const Hit& hit, const Vector3& ray, const Lighting& lighting, const Vector3& lamp_camera_m) {
  if (hit.panel == nullptr) return 0.0;
  const Vector3 to_lamp = (lamp_camera_m - hit.depth * ray).normalized();
  const double lit = lighting.ambient + lighting.diffuse * std::abs(hit.panel->normal.dot(to_lamp));
  return lit * static_cast<double>(hit.panel->texture->at(hit.s, hit.t));
}

}  // namespace

std::vector<Vector2> pixel_rays(const PinholeCamera& camera, int rays_per_side) {
  std::vector<Vector2> rays;
  for (std::int32_t v = 0; v < camera.height_px; ++v) {
    for (std::int32_t u = 0; u < camera.width_px; ++u) {
      for (int k = 0; k < rays_per_side * rays_per_side; ++k) {
        const Vector2 pixel(u + (k % rays_per_side + 0.5) / rays_per_side - 0.5,
                            v + (k / rays_per_side + 0.5) / rays_per_side - 0.5);
        const auto ray = undistort(camera, pixel);
        rays.push_back(ray ? *ray : Vector2(1e6, 1e6));
      }
    }
  }
  return rays;
}

void draw_stars(LinearImage& image, const std::vector<Star>& stars, const PinholeCamera& camera,
                const Pose<frame::Rig, frame::Camera>& T_scene_camera) {
  for (const Star& star : stars) {
    const Vector3 d = T_scene_camera.R.transpose() * star.direction;
    if (d.z() <= 0.1) continue;
    const Vector2 pixel = distort(camera, Vector2(d.x() / d.z(), d.y() / d.z()));
    const auto u = static_cast<std::int32_t>(std::lround(pixel.x()));
    const auto v = static_cast<std::int32_t>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= camera.width_px || v >= camera.height_px) continue;
    if (image.at(u, v) <= 0.0F) image.at(u, v) = static_cast<float>(star.light);
  }
}

LinearImage cast_panels(const PanelScene& scene, const Lighting& lighting, const PinholeCamera& camera,
                        const std::vector<Vector2>& rays, int rays_per_side,
                        const Pose<frame::Rig, frame::Camera>& T_scene_camera) {
  const Pose<frame::Camera, frame::Rig> T_camera_scene = T_scene_camera.inverse();
  std::vector<CameraPanel> panels;
  panels.reserve(scene.panels.size());
  for (const Panel& panel : scene.panels) panels.push_back(seen_from(panel, scene, camera, T_camera_scene));
  const Vector3 lamp = T_camera_scene * lighting.lamp_m;
  LinearImage image{camera.width_px, camera.height_px, {}};
  image.light.assign(static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px), 0.0F);
  const int count = rays_per_side * rays_per_side;
  std::vector<const CameraPanel*> row;
  for (std::int32_t v = 0; v < camera.height_px; ++v) {
    row.clear();
    for (const CameraPanel& panel : panels) {
      if (v >= panel.first_v && v <= panel.last_v) row.push_back(&panel);
    }
    if (row.empty()) continue;
    const Vector2* ray = rays.data() + static_cast<std::ptrdiff_t>(v) * camera.width_px * count;
    for (std::int32_t u = 0; u < camera.width_px; ++u) {
      double sum = 0.0;
      int hits = 0;
      for (int k = 0; k < count; ++k, ++ray) {
        const Vector3 direction(ray->x(), ray->y(), 1.0);
        const Hit hit = nearest(row, u, direction);
        hits += hit.panel != nullptr ? 1 : 0;
        sum += light_of(hit, direction, lighting, lamp);
      }
      if (hits > 0) image.at(u, v) = static_cast<float>(sum / count);
    }
  }
  return image;
}

}  // namespace pharos::sim
