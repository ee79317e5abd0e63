// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/render/solid_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/sim/render/solid_shapes.hpp"
#include "tools/sim/render/solid_tiles.hpp"
#include "tools/sim/render/subpixels.hpp"

namespace pharos::sim {
namespace {

// A shadow's ray begins so far off the surface.
constexpr double kOffSurface_m = 1e-5;
// Difference of light between neighbours that is worth a few rays, and all of them. A slope within one surface is a
// tenth of its step off where a few rays are evenly spread.
constexpr float kWorthFew = 0.01F, kWorthAll = 0.06F;
constexpr int kFewRays = 4;
constexpr double kShininess = 40.0;

double hashed(std::int64_t x, std::int64_t y) {
  std::uint64_t h =
      static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^ static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL;
  h = (h ^ (h >> 31)) * 0xBF58476D1CE4E5B9ULL;
  h ^= h >> 29;
  return static_cast<double>(h >> 11) * 0x1p-53 - 0.5;
}

// Smooth random values on a lattice, -0.5 to 0.5.
double noise_at(double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double a = ease(x - fx), b = ease(y - fy);
  const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
  return (1 - b) * ((1 - a) * hashed(i, j) + a * hashed(i + 1, j)) +
         b * ((1 - a) * hashed(i, j + 1) + a * hashed(i + 1, j + 1));
}

// Where on the lattice of random values a surface's pattern begins.
Vector2 pattern_origin(const SolidHit& hit, const Material& material) {
  if (material.pattern == 0) return Vector2::Zero();
  const auto which = static_cast<std::int64_t>(material.pattern) * 8 + hit.face;
  return 1e5 * Vector2(hashed(which, 1), hashed(which, 2));
}

// Noise of a surface with a pattern has finer parts too.
double roughness_at(const Vector2& p, const Material& material) {
  const double coarse = noise_at(p.x(), p.y());
  if (material.pattern == 0) return coarse;
  return 0.75 * coarse + 0.5 * noise_at(3.1 * p.x(), 3.1 * p.y());
}

Vector3 wrinkled(const Vector3& normal, const SolidHit& hit, const Material& material) {
  const Vector2 p = hit.place_m / material.bump_size_m + pattern_origin(hit, material);
  const Vector3 tilt(roughness_at(p, material), roughness_at(p + Vector2(91.7, 13.1), material),
                     roughness_at(p + Vector2(47.3, -71.9), material));
  return (normal + 2.0 * material.bumps * tilt).normalized();
}

// Stains where there are no cells, else each cell's own shade: a factor on the albedo.
double paint_at(const SolidHit& hit, const Material& material) {
  if (material.paint_contrast <= 0.0) return 1.0;
  const Vector2 origin = pattern_origin(hit, material);
  if (material.line_m > 0.0 && material.cell_m.minCoeff() > 0.0) {
    return 1.0 + 2.0 * material.paint_contrast *
                     hashed(static_cast<std::int64_t>(std::floor(hit.place_m.x() / material.cell_m.x())) +
                                static_cast<std::int64_t>(origin.x()),
                            static_cast<std::int64_t>(std::floor(hit.place_m.y() / material.cell_m.y())) +
                                static_cast<std::int64_t>(origin.y()));
  }
  return 1.0 + 2.0 * material.paint_contrast * roughness_at(hit.place_m / material.bump_size_m - origin, material);
}

double albedo_at(const SolidHit& hit, const Material& material) {
  if (material.line_m <= 0.0) return material.albedo * paint_at(hit, material);
  for (int axis = 0; axis < 2; ++axis) {
    const double cell = material.cell_m[axis];
    if (cell <= 0.0) continue;
    const double at = std::abs(hit.place_m[axis] - cell * std::round(hit.place_m[axis] / cell));
    if (at < 0.5 * material.line_m) return material.line_albedo;
  }
  return material.albedo * paint_at(hit, material);
}

// Places on the sun's disc: its middle, or seven of equal weight.
std::vector<Vector3> sun_directions(const SolidScene& scene) {
  std::vector<Vector3> out{scene.to_sun};
  if (scene.sun_radius_rad <= 0.0) return out;
  const Vector3 across = scene.to_sun.unitOrthogonal(), along = scene.to_sun.cross(across);
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3.0, radius = 0.76 * scene.sun_radius_rad;
    out.push_back((scene.to_sun + radius * (std::cos(angle) * across + std::sin(angle) * along)).normalized());
  }
  return out;
}

// Which solids may be between a place and the sun: by where a place is seen from the sun.
class SunMap {
 public:
  SunMap(const std::vector<Bounds>& bounds, const Vector3& to_sun, double sun_radius_rad)
      : across_(to_sun.unitOrthogonal()), along_(to_sun.cross(across_)) {
    double nearest = kNever, farthest = -kNever;  // towards the sun
    Vector2 high = Vector2::Constant(-kNever);
    for (const Bounds& b : bounds) {
      low_ = low_.cwiseMin(seen(b.centre_m) - Vector2::Constant(b.radius_m));
      high = high.cwiseMax(seen(b.centre_m) + Vector2::Constant(b.radius_m));
      nearest = std::min(nearest, b.centre_m.dot(to_sun) - b.radius_m);
      farthest = std::max(farthest, b.centre_m.dot(to_sun));
    }
    if (bounds.empty()) return;
    step_ = (high - low_).cwiseMax(1e-6) / kCells;
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      // Half shadows widen with the distance; and a place is a little off its surface.
      const double reach = bounds[k].radius_m + sun_radius_rad * (farthest - nearest) + 10.0 * kOffSurface_m;
      const Vector2 middle = seen(bounds[k].centre_m);
      const Cell first = cell_at(middle - Vector2::Constant(reach)), last = cell_at(middle + Vector2::Constant(reach));
      for (int row = first.row; row <= last.row; ++row) {
        for (int column = first.column; column <= last.column; ++column) list({column, row}).push_back(k);
      }
    }
  }

  const std::vector<std::size_t>& at(const Vector3& place) const { return lists_[index(cell_at(seen(place)))]; }

 private:
  static constexpr int kCells = 64;  // a side
  struct Cell {
    int column, row;
  };
  Vector2 seen(const Vector3& place) const { return {across_.dot(place), along_.dot(place)}; }
  Cell cell_at(const Vector2& p) const {
    const Vector2 cell = (p - low_).cwiseQuotient(step_).cwiseMax(0.0).cwiseMin(kCells - 1.0);
    return {static_cast<int>(cell.x()), static_cast<int>(cell.y())};
  }
  static std::size_t index(const Cell& cell) { return static_cast<std::size_t>(cell.row * kCells + cell.column); }
  std::vector<std::size_t>& list(const Cell& cell) { return lists_[index(cell)]; }

  Vector3 across_, along_;
  Vector2 low_ = Vector2::Constant(kNever), step_ = Vector2::Ones();
  std::vector<std::vector<std::size_t>> lists_{static_cast<std::size_t>(kCells * kCells)};
};

std::vector<Bounds> bounds_in_scene(const SolidScene& scene) {
  std::vector<Bounds> out;
  for (const Solid& solid : scene.solids) {
    const Bounds bounds = bounds_of(solid);
    out.push_back({solid.R * bounds.centre_m + solid.t_m, bounds.radius_m});
  }
  return out;
}

class Caster {
 public:
  Caster(const SolidScene& scene, const Vector3& eye)
      : scene_(scene),
        eye_(eye),
        bounds_(bounds_in_scene(scene)),
        suns_(sun_directions(scene)),
        sun_map_(bounds_, scene.to_sun, scene.sun_radius_rad) {
    for (const Solid& solid : scene.solids) eyes_.push_back(solid.R.transpose() * (eye - solid.t_m));
  }

  struct Seen {
    double light = 0.0;
    int solid = -1;
  };

  Seen look(const Vector3& direction, const std::vector<std::uint16_t>& candidates) const {
    SolidHit nearest;
    int which = -1;
    for (const std::uint16_t k : candidates) {
      const Solid& solid = scene_.solids[k];
      // Past the sphere around it.
      if ((bounds_[k].centre_m - eye_).cross(direction).squaredNorm() >
          bounds_[k].radius_m * bounds_[k].radius_m * direction.squaredNorm()) {
        continue;
      }
      const Vector3 d = solid.R.transpose() * direction;
      const SolidHit hit = std::visit([&](const auto& shape) { return meet(shape, eyes_[k], d, 1e-9); }, solid.shape);
      if (hit.depth >= nearest.depth) continue;
      nearest = hit;
      which = k;
    }
    if (which < 0) return {};
    return {light_of(scene_.solids[static_cast<std::size_t>(which)], nearest, direction), which};
  }

  const std::vector<Bounds>& bounds() const { return bounds_; }

 private:
  SolidHit meet_solid(std::size_t k, const Vector3& origin, const Vector3& direction, double nearest) const {
    const Solid& solid = scene_.solids[k];
    const Vector3 o = solid.R.transpose() * (origin - solid.t_m), d = solid.R.transpose() * direction;
    return std::visit([&](const auto& shape) { return meet(shape, o, d, nearest); }, solid.shape);
  }

  // Part of the sun that is seen from a place on the lit side of a solid: a box does not shade itself.
  double sun_seen(const Vector3& place, const Solid& own) const {
    std::vector<std::size_t>& near = in_the_way_;
    near.clear();
    for (const std::size_t k : sun_map_.at(place)) {
      if (&scene_.solids[k] == &own && std::holds_alternative<SolidBox>(own.shape)) continue;
      const Vector3 to = bounds_[k].centre_m - place;
      const double along = to.dot(scene_.to_sun);
      if (along < -bounds_[k].radius_m) continue;
      const double reach = bounds_[k].radius_m + scene_.sun_radius_rad * std::max(0.0, along);
      if ((to - along * scene_.to_sun).squaredNorm() <= reach * reach) near.push_back(k);
    }
    if (near.empty()) return 1.0;
    std::size_t seen = 0;
    for (const Vector3& sun : suns_) {
      seen += std::none_of(near.begin(), near.end(),
                           [&](std::size_t k) { return meet_solid(k, place, sun, kOffSurface_m).depth != kNever; });
    }
    return static_cast<double>(seen) / static_cast<double>(suns_.size());
  }

  double light_of(const Solid& solid, const SolidHit& hit, const Vector3& direction) const {
    const Material& material = solid.material;
    const Vector3 sight = direction.normalized();
    Vector3 flat = solid.R * hit.normal;
    if (flat.dot(sight) > 0.0) flat = -flat;
    const Vector3 normal = material.bumps > 0.0 ? wrinkled(flat, hit, material) : flat;
    const double albedo = albedo_at(hit, material);
    double light = scene_.fill * albedo * std::max(0.0, -normal.dot(sight));
    const double sun = normal.dot(scene_.to_sun);
    if (sun <= 0.0 || flat.dot(scene_.to_sun) <= 0.0) return light;
    const double seen = sun_seen(eye_ + hit.depth * direction + kOffSurface_m * flat, solid);
    light += seen * albedo * sun;
    if (material.gloss > 0.0 && seen > 0.0) {
      const Vector3 between = (scene_.to_sun - sight).normalized();
      light += seen * material.gloss * std::pow(std::max(0.0, between.dot(normal)), kShininess);
    }
    return light;
  }

  const SolidScene& scene_;
  Vector3 eye_;
  std::vector<Vector3> eyes_;  // in each solid's frame
  std::vector<Bounds> bounds_;
  std::vector<Vector3> suns_;
  SunMap sun_map_;
  mutable std::vector<std::size_t> in_the_way_;  // of one place, kept for its memory
};

std::vector<Subpixel> even_subpixels(int count) { return blurred_subpixels(count, 0.0); }

// Of a pixel's light to its eight neighbours'; to another solid it is as large as can be.
float largest_step(const LinearImage& image, const std::vector<std::int16_t>& solids, int u, int v) {
  const auto solid_at = [&](int x, int y) { return solids[static_cast<std::size_t>(y * image.width_px + x)]; };
  float largest = 0.0F;
  for (int y = std::max(0, v - 1); y <= std::min(image.height_px - 1, v + 1); ++y) {
    for (int x = std::max(0, u - 1); x <= std::min(image.width_px - 1, u + 1); ++x) {
      if (solid_at(x, y) != solid_at(u, v)) return std::numeric_limits<float>::infinity();
      largest = std::max(largest, std::abs(image.at(x, y) - image.at(u, v)));
    }
  }
  return largest;
}

}  // namespace

LinearImage solid_image(const SolidScene& scene, const Lens& lens, const Matrix3& R_scene_camera,
                        const Vector3& t_scene_camera_m, int rays) {
  const Caster caster(scene, t_scene_camera_m);
  const auto pixels = static_cast<std::size_t>(lens.width_px) * static_cast<std::size_t>(lens.height_px);
  LinearImage image{lens.width_px, lens.height_px, std::vector<float>(pixels, 0.0F)};
  std::vector<std::int16_t> solids(pixels, -1);
  const LensRays rays_of(lens);
  const Tiles tiles(lens, rays_of, caster.bounds(), R_scene_camera, t_scene_camera_m);
  const auto look = [&](double u, double v, const std::vector<std::uint16_t>& list) -> Caster::Seen {
    const auto ray = rays_of.at(u, v);
    if (!ray) return {};
    return caster.look(R_scene_camera * Vector3(ray->x(), ray->y(), 1.0), list);
  };
  for (int v = 0; v < lens.height_px; ++v) {
    for (int u = 0; u < lens.width_px; ++u) {
      const auto& list = tiles.at(u, v);
      if (list.empty()) continue;
      const Caster::Seen seen = look(u, v, list);
      image.at(u, v) = static_cast<float>(seen.light);
      solids[static_cast<std::size_t>(v * lens.width_px + u)] = static_cast<std::int16_t>(seen.solid);
    }
  }
  const std::vector<Subpixel> all = even_subpixels(rays), few = even_subpixels(std::min(rays, kFewRays));
  const LinearImage once = image;
  for (int v = 0; v < lens.height_px; ++v) {
    for (int u = 0; u < lens.width_px; ++u) {
      const auto& list = tiles.at(u, v);
      if (list.empty()) continue;
      const float step = largest_step(once, solids, u, v);
      if (!(step > kWorthFew)) continue;
      const std::vector<Subpixel>& places = step > kWorthAll ? all : few;
      double sum = 0.0;
      for (const Subpixel& place : places) sum += look(u + place[0], v + place[1], list).light;
      image.at(u, v) = static_cast<float>(sum / static_cast<double>(places.size()));
    }
  }
  return image;
}

}  // namespace pharos::sim
