// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pointing/random_satellite.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSkyLight = 0.004;
constexpr double kMargin_px = 15.0;

// The wing's frame: x along the axis, z the panels' normal; R takes it to C.
struct Builder {
  RandomStream random;
  Matrix3 R = Matrix3::Identity();
  Vector3 t_m = Vector3::Zero();
  SolidScene scene;

  void add(const std::variant<SolidBox, FlatRing, ConeShell, Dish>& shape, const Material& material, const Vector3& at,
           const Matrix3& turn = Matrix3::Identity()) {
    scene.solids.push_back({shape, material, R * turn, R * at + t_m});
  }
  double between(double low, double high) { return random.uniform(low, high); }
};

Matrix3 about_x(double angle) {
  Matrix3 R = Matrix3::Identity();
  R(1, 1) = R(2, 2) = std::cos(angle);
  R(2, 1) = std::sin(angle);
  R(1, 2) = -R(2, 1);
  return R;
}

// Axis at `from_sight` from the line of sight, the normal towards the camera and then turned by `roll` about it.
Matrix3 wing_frame(double from_sight, double turn, double roll) {
  const Vector3 axis(std::sin(from_sight) * std::cos(turn), std::sin(from_sight) * std::sin(turn),
                     std::cos(from_sight));
  const Vector3 to_camera = -Vector3::UnitZ();
  Vector3 normal = (to_camera - to_camera.dot(axis) * axis).normalized();
  normal = std::cos(roll) * normal + std::sin(roll) * axis.cross(normal);
  Matrix3 R;
  R << axis, normal.cross(axis), normal;
  return R;
}

void add_body(Builder& b, const Vector3& half_m, double angle, const Material& foil, const Material& metal) {
  const Matrix3 turn = about_x(angle);
  b.add(SolidBox{-half_m, half_m}, foil, Vector3::Zero(), turn);
  if (b.random.chance(0.6)) {  // a dish
    const double radius = b.between(0.4, 1.1) * half_m.y(), from = b.between(-0.2, 0.8) * radius;
    Matrix3 facing = turn;
    if (b.random.chance(0.5)) facing = turn * about_x(b.between(0.0, 2.0 * std::numbers::pi));
    b.add(Dish{radius, from}, metal, facing * Vector3(0.0, 0.0, half_m.z() + b.between(0.0, 0.5) * radius - from),
          facing);
  }
  if (b.random.chance(0.4)) {  // a boom
    const double radius = b.between(0.01, 0.05);
    b.add(ConeShell{radius, radius, b.between(1.0, 4.0)}, metal, turn * Vector3(0.0, 0.0, half_m.z()),
          turn * about_x(b.between(-0.6, 0.6)));
  }
  if (b.random.chance(0.4)) {  // a square cover that stands off the body
    const double side = b.between(0.2, 0.9) * std::min(half_m.x(), half_m.y());
    b.add(SolidBox{{-side, -side, 0.0}, {side, side, 0.05}}, b.random.chance(0.5) ? foil : metal,
          turn * Vector3(0.0, 0.0, half_m.z() + 0.05), turn);
  }
}

void look(RandomSatellite& satellite, const std::vector<Vector3>& corners_m) {
  satellite.in_image = true;
  const Lens& lens = satellite.lens;
  std::vector<Vector2> pixels;
  for (const Vector3& corner : corners_m) {
    const Vector2 pixel = pixel_of(lens, corner);
    pixels.push_back(pixel);
    satellite.in_image = satellite.in_image && corner.z() > 0.0 && pixel.x() > kMargin_px && pixel.y() > kMargin_px &&
                         pixel.x() < lens.width_px - kMargin_px && pixel.y() < lens.height_px - kMargin_px;
  }
  for (std::size_t k = 0; k + 1 < pixels.size(); k += 2) {
    satellite.panel_px = std::max(satellite.panel_px, (pixels[k + 1] - pixels[k]).norm());
  }
}

}  // namespace

RandomSatellite random_satellite(std::uint64_t seed) {
  RandomSatellite satellite;
  Builder b{RandomStream(seed, "line satellite"), {}, {}, {}};
  satellite.lens = centred_lens(1600, 1200, std::exp(b.between(std::log(1800.0), std::log(9000.0))));
  satellite.panels = b.random.chance(0.8) ? 2 : 1;
  const double length_m = b.between(2.5, 12.0), width_m = length_m / b.between(1.45, 5.0), gap_m = b.between(0.15, 1.2);
  const Vector3 half_m(b.between(0.4, 1.6), b.between(0.4, 1.6), b.between(0.4, 1.6));
  satellite.from_sight_rad = std::acos(b.between(0.0, 1.0));
  const double roll = b.between(-60.0, 60.0) * kDegree;
  b.R = wing_frame(satellite.from_sight_rad, b.between(0.0, 2.0 * std::numbers::pi), roll);
  satellite.axis_camera = b.R.col(0);
  const double reach_m = half_m.x() + gap_m + length_m;
  const double span_m = std::max(0.35, std::sin(satellite.from_sight_rad)) * 2.0 * reach_m;
  const double range_m = std::max(1.3 * reach_m, satellite.lens.fx_px * span_m / b.between(500.0, 1150.0));
  b.t_m = range_m * Vector3(b.between(-0.01, 0.01), b.between(-0.01, 0.01), 1.0);
  Material cells{b.between(0.15, 0.6)};
  cells.cell_m = {b.between(0.3, 1.2), b.between(0.2, 0.8)};
  cells.line_m = b.random.chance(0.8) ? b.between(0.01, 0.06) : 0.0;
  cells.line_albedo = b.between(0.2, 0.95);
  const Material foil{b.between(0.15, 0.8), b.between(0.0, 0.6), b.between(0.0, 0.45), b.between(0.05, 0.3)};
  const Material metal{b.between(0.4, 0.9), b.between(0.0, 0.4)};
  std::vector<Vector3> corners_m;
  for (int k = 0; k < satellite.panels; ++k) {
    const double from = k == 0 ? half_m.x() + gap_m : -half_m.x() - gap_m - length_m;
    b.add(SolidBox{{0.0, 0.0, -0.01}, {length_m, width_m, 0.01}}, cells, {from, -0.5 * width_m, 0.0});
    b.add(ConeShell{0.04, 0.04, gap_m}, metal, {k == 0 ? half_m.x() : -half_m.x() - gap_m, 0.0, 0.0},
          (Matrix3() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished());
    for (const double y : {-0.5 * width_m, 0.5 * width_m}) {
      for (const double x : {from, from + length_m}) corners_m.push_back(b.R * Vector3(x, y, 0.0) + b.t_m);
    }
  }
  add_body(b, half_m, b.between(0.0, std::numbers::pi), foil, metal);
  satellite.scene = std::move(b.scene);
  const Vector3 sight = b.t_m.normalized();
  Vector3 seen = b.R.col(2);
  if (seen.dot(sight) > 0.0) seen = -seen;
  satellite.panel_tilt_rad = std::acos(std::clamp(-seen.dot(sight), -1.0, 1.0));
  const Vector3 aside(b.random.normal(), b.random.normal(), b.random.normal());
  satellite.scene.to_sun = (seen - 0.5 * sight + 0.6 * aside.normalized()).normalized();
  satellite.sun_incidence_rad = std::acos(std::clamp(seen.dot(satellite.scene.to_sun), -1.0, 1.0));
  satellite.scene.fill = b.between(0.005, 0.08);
  satellite.blur_px = b.between(0.6, 1.6);
  satellite.electrons_per_light = b.between(6000.0, 13000.0);
  satellite.stars = b.random.below(80);
  look(satellite, corners_m);
  return satellite;
}

host::GreyImage image_of(const RandomSatellite& satellite, std::uint64_t seed) {
  LinearImage light = solid_image(satellite.scene, satellite.lens, Matrix3::Identity(), Vector3::Zero());
  RandomStream random(seed, "line pixels");
  for (int k = 0; k < satellite.stars; ++k) {
    const auto u = static_cast<std::int32_t>(random.uniform(1.0, light.width_px - 2.0));
    const auto v = static_cast<std::int32_t>(random.uniform(1.0, light.height_px - 2.0));
    const double brightness = 3.0 / std::sqrt(1.0 + 80.0 * random.uniform());
    if (light.at(u, v) <= 0.0F) light.at(u, v) = static_cast<float>(brightness);
  }
  for (float& pixel : light.light) pixel += static_cast<float>(kSkyLight);
  ImageSensor sensor;
  sensor.electrons_per_light = satellite.electrons_per_light;
  return expose(blurred(light, satellite.blur_px), sensor, random);
}

}  // namespace pharos::sim
