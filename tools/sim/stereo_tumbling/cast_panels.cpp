// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/cast_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/sim/render/primitives.hpp"

namespace pharos::sim {
namespace {

constexpr std::int32_t kTile_px = 16;
constexpr double kNearest_m = 0.05;
// What rounding may do to a panel's border, in parts of its distance.
constexpr double kRounding = 1e-9;

// A panel in the camera's frame.
struct CameraPanel {
  PlaneCoordinates plane;
  const Texture* texture = nullptr;
  std::array<Vector3, 4> corners;
  std::size_t number = 0;  // in the scene
  double nearest_m = 0.0;  // no point of it is less deep
};

CameraPanel seen_from(const Panel& panel, const PanelScene& scene,
                      const Pose<frame::Camera, frame::Rig>& T_camera_scene, std::size_t number) {
  const Vector3 corner = T_camera_scene * panel.corner_m;
  const Vector3 s = T_camera_scene.R * panel.edge_s_m, t = T_camera_scene.R * panel.edge_t_m;
  CameraPanel out{PlaneCoordinates(corner, s, t),
                  &scene.textures[static_cast<std::size_t>(panel.texture)],
                  {corner, corner + s, corner + t, corner + s + t},
                  number,
                  kNever};
  for (const Vector3& p : out.corners) out.nearest_m = std::min(out.nearest_m, p.z() - kRounding * p.norm());
  return out;
}

// The nearest first: behind a panel that is hit, those that begin deeper need no look.
std::vector<CameraPanel> sorted_panels(const PanelScene& scene, const Pose<frame::Camera, frame::Rig>& T_camera_scene) {
  std::vector<CameraPanel> out;
  out.reserve(scene.panels.size());
  for (const Panel& panel : scene.panels) out.push_back(seen_from(panel, scene, T_camera_scene, out.size()));
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.nearest_m < b.nearest_m; });
  return out;
}

// A rectangle of the image, and what its rays (x/z, y/z) lie within: exact whatever the lens does.
class Tile {
 public:
  Tile(const Lens& lens, const RayGrid& rays, int rays_per_side, std::int32_t u, std::int32_t v)
      : first_u(u),
        first_v(v),
        end_u(std::min(u + kTile_px, lens.width_px)),
        end_v(std::min(v + kTile_px, lens.height_px)) {
    for (int row = first_v * rays_per_side; row < end_v * rays_per_side; ++row) {
      const Vector2* ray = rays.row_begin(row, first_u * rays_per_side);
      for (int k = (end_u - first_u) * rays_per_side; k > 0; --k, ++ray) {
        low_ = low_.cwiseMin(*ray);
        high_ = high_.cwiseMax(*ray);
      }
    }
  }

  // Not where all corners are on the far side of one of its five planes: the panel between them is too.
  bool may_show(const CameraPanel& panel) const {
    std::array<int, 5> beyond{};
    for (const Vector3& p : panel.corners) {
      const double rounding = kRounding * p.norm();
      beyond[0] += p.z() < kNearest_m - rounding;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto k = static_cast<Eigen::Index>(axis);
        beyond[1 + 2 * axis] += p[k] < low_[k] * p.z() - rounding;
        beyond[2 + 2 * axis] += p[k] > high_[k] * p.z() + rounding;
      }
    }
    return std::find(beyond.begin(), beyond.end(), 4) == beyond.end();
  }

  std::int32_t first_u, first_v, end_u, end_v;

 private:
  Vector2 low_ = Vector2::Constant(kNever), high_ = Vector2::Constant(-kNever);
};

struct Hit {
  double depth = kNever;
  const CameraPanel* panel = nullptr;
  double s = 0.0, t = 0.0;
};

// Of two panels at one depth, the scene's first.
Hit nearest(const std::vector<const CameraPanel*>& panels, const Vector3& ray) {
  Hit hit;
  for (const CameraPanel* panel : panels) {
    if (panel->nearest_m > hit.depth) break;
    const double depth = panel->plane.depth(ray);
    const bool before = hit.panel != nullptr && depth == hit.depth && panel->number < hit.panel->number;
    if (!(depth > kNearest_m && (depth < hit.depth || before))) continue;
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
  const std::vector<CameraPanel> panels = sorted_panels(scene, T_camera_scene);
  const Vector3 lamp = T_camera_scene * lighting.lamp_m;
  LinearImage image{lens.width_px, lens.height_px, {}};
  image.light.assign(static_cast<std::size_t>(lens.width_px) * static_cast<std::size_t>(lens.height_px), 0.0F);
  std::vector<const CameraPanel*> shown;
  const auto light_at = [&](std::int32_t u, std::int32_t v) {
    double sum = 0.0;
    for (int down = 0; down < rays_per_side; ++down) {
      const Vector2* ray = rays.row_begin(v * rays_per_side + down, u * rays_per_side);
      for (int across = 0; across < rays_per_side; ++across, ++ray) {
        const Vector3 direction(ray->x(), ray->y(), 1.0);
        sum += light_of(nearest(shown, direction), direction, lighting, lamp);
      }
    }
    return static_cast<float>(sum / (rays_per_side * rays_per_side));
  };
  for (std::int32_t first_v = 0; first_v < lens.height_px; first_v += kTile_px) {
    for (std::int32_t first_u = 0; first_u < lens.width_px; first_u += kTile_px) {
      const Tile tile(lens, rays, rays_per_side, first_u, first_v);
      shown.clear();
      for (const CameraPanel& panel : panels) {
        if (tile.may_show(panel)) shown.push_back(&panel);
      }
      if (shown.empty()) continue;
      for (std::int32_t v = tile.first_v; v < tile.end_v; ++v) {
        for (std::int32_t u = tile.first_u; u < tile.end_u; ++u) image.at(u, v) = light_at(u, v);
      }
    }
  }
  return image;
}

}  // namespace pharos::sim
