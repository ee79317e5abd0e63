// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/random_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/sim/random_stream.hpp"
#include "tools/sim/render/solid_shapes.hpp"

namespace pharos::sim {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

using Shape = std::variant<SolidBox, FlatRing, ConeShell, Dish>;

// Half a turn about z.
const Matrix3 kOpposite = Vector3(-1.0, -1.0, 1.0).asDiagonal();

struct Builder {
  RandomStream random;
  RandomBody body;
  std::uint32_t patterns = 0;
  Vector3 half_m = Vector3::Zero();  // of the bus
  bool round = false;

  double between(double low, double high) { return random.uniform(low, high); }
  double sign() { return random.chance(0.5) ? 1.0 : -1.0; }

  void add(const Shape& shape, const Material& material, const Vector3& at, const Matrix3& R = Matrix3::Identity()) {
    Material own = material;
    own.pattern = ++patterns;
    body.scene.solids.push_back({shape, own, R, at});
  }
  // The last `count` solids once more on the opposite side, alike to the last stain.
  void repeat_opposite(std::size_t count) {
    auto& solids = body.scene.solids;
    const std::size_t first = solids.size() - count;
    for (std::size_t k = first; k < first + count; ++k) {
      Solid like = solids[k];
      like.R = kOpposite * like.R;
      like.t_m = kOpposite * like.t_m;
      solids.push_back(like);
    }
  }
  void finish_part(std::size_t from) {
    if (body.symmetric) repeat_opposite(body.scene.solids.size() - from);
  }
};

// Wrinkled foil, sometimes glossy, or painted sheet.
Material skin(Builder& b) {
  Material out{b.between(0.2, 0.65)};
  const bool foil = b.random.chance(0.7);
  out.bumps = foil ? b.between(0.15, 0.5) : b.between(0.0, 0.08);
  out.bump_size_m = b.between(0.03, 0.15);
  out.paint_contrast = foil ? b.between(0.05, 0.4) : b.between(0.2, 0.6);
  out.gloss = b.random.chance(0.5) ? b.between(0.05, 0.8) : 0.0;
  return out;
}

Material metal(Builder& b) {
  Material out{b.between(0.3, 0.9), b.between(0.0, 0.3)};
  out.bump_size_m = b.between(0.04, 0.15);
  out.paint_contrast = b.between(0.05, 0.35);
  return out;
}

Material solar_cells(Builder& b) {
  Material out{b.between(0.08, 0.35), b.between(0.0, 0.2)};
  out.cell_m = {b.between(0.08, 0.3), b.between(0.08, 0.3)};
  out.line_m = b.between(0.006, 0.02);
  out.line_albedo = b.between(0.3, 0.8);
  out.paint_contrast = b.between(0.1, 0.45);
  return out;
}

// z of the shape along `z`.
Matrix3 along(const Vector3& z) {
  Matrix3 R;
  R.col(2) = z.normalized();
  R.col(0) = R.col(2).unitOrthogonal();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

void add_bus(Builder& b) {
  b.half_m = {b.between(0.45, 0.9), b.between(0.45, 0.9), b.between(0.5, 1.0)};
  b.round = b.random.chance(0.25);
  const Material cover = skin(b);
  if (!b.round) return b.add(SolidBox{-b.half_m, b.half_m}, cover, Vector3::Zero());
  b.half_m.y() = b.half_m.x();
  const Vector3 down(0.0, 0.0, -b.half_m.z());
  b.add(ConeShell{b.half_m.x(), b.half_m.x(), 2.0 * b.half_m.z()}, cover, down);
  b.add(FlatRing{0.0, b.half_m.x()}, skin(b), down);
  b.add(FlatRing{0.0, b.half_m.x()}, skin(b), -down);
}

void add_wing(Builder& b, double side) {
  const double gap_m = b.between(0.1, 0.4), length_m = b.between(0.7, 2.0), width_m = b.between(0.5, 1.5);
  const Matrix3 R = rotation_exp(Vector3(b.between(-1.2, 1.2), 0.0, 0.0));
  const double from = b.half_m.x() + gap_m, low = side > 0.0 ? from : -from - length_m;
  b.add(SolidBox{{low, -0.5 * width_m, -0.015}, {low + length_m, 0.5 * width_m, 0.015}}, solar_cells(b),
        Vector3::Zero(), R);
  b.add(ConeShell{0.02, 0.02, gap_m}, metal(b), {side > 0.0 ? b.half_m.x() : -from, 0.0, 0.0}, along(Vector3::UnitX()));
}

void add_wings(Builder& b) {
  if (!b.body.symmetric && b.random.chance(0.2)) return;
  const std::size_t from = b.body.scene.solids.size();
  add_wing(b, 1.0);
  b.finish_part(from);
  if (!b.body.symmetric && b.random.chance(0.8)) add_wing(b, -1.0);
}

// A place on the bus' skin and its normal.
struct Place {
  Vector3 at = Vector3::Zero(), normal = Vector3::UnitZ();
};

Place on_bus(Builder& b, double size_m) {
  const auto room = [&](int axis) { return std::max(0.0, b.half_m[axis] - size_m); };
  const double angle = b.between(0.0, kTurn_rad), up = b.sign();
  if (b.random.chance(0.5)) {  // an end
    const double across = b.round ? 0.7 : 1.0;
    return {{across * b.between(-room(0), room(0)), across * b.between(-room(1), room(1)), up * b.half_m.z()},
            up * Vector3::UnitZ()};
  }
  const double height = b.between(-room(2), room(2));
  if (b.round) {
    const Vector3 normal(std::cos(angle), std::sin(angle), 0.0);
    return {b.half_m.x() * normal + Vector3(0.0, 0.0, height), normal};
  }
  return {{b.between(-room(0), room(0)), up * b.half_m.y(), height}, up * Vector3::UnitY()};
}

void add_cover(Builder& b) {
  const double a = b.between(0.08, 0.3), c = b.between(0.08, 0.3), high = b.between(0.02, 0.25);
  const Place place = on_bus(b, std::max(a, c));
  const double sunk = b.round ? 0.08 : 0.0;
  b.add(SolidBox{{-a, -c, -sunk}, {a, c, high}}, b.random.chance(0.5) ? metal(b) : skin(b), place.at,
        along(place.normal));
}

void add_thruster(Builder& b) {
  const double exit_m = b.between(0.05, 0.2), length_m = b.between(0.1, 0.35);
  const Place place = on_bus(b, exit_m);
  b.add(ConeShell{b.between(0.25, 0.6) * exit_m, exit_m, length_m}, metal(b), place.at, along(place.normal));
}

void add_mast(Builder& b) {
  const Place place = on_bus(b, 0.1);
  const double length_m = b.between(0.4, 1.3);
  const Vector3 way =
      (place.normal + Vector3(b.between(-0.5, 0.5), b.between(-0.5, 0.5), b.between(-0.5, 0.5))).normalized();
  b.add(ConeShell{0.02, 0.015, length_m}, metal(b), place.at, along(way));
  b.add(Dish{b.between(0.03, 0.08), -1.0}, metal(b), place.at + length_m * way);
}

void add_dish(Builder& b) {
  const double radius_m = b.between(0.3, 0.8), rim = b.between(0.3, 0.85) * radius_m;
  const Place place = on_bus(b, 0.2);
  const double away = b.between(0.1, 0.4);
  const Vector3 middle = place.at + (away + radius_m) * place.normal;
  b.add(Dish{radius_m, rim}, b.random.chance(0.5) ? skin(b) : metal(b), middle, along(-place.normal));
  b.add(ConeShell{0.04, 0.04, away}, metal(b), place.at, along(place.normal));
}

void add_ring(Builder& b) {
  const double outer_m = b.between(0.5, 0.9) * std::min(b.half_m.x(), b.half_m.y()), high = b.between(0.03, 0.15);
  const double end = b.sign();
  const Vector3 at(0.0, 0.0, end * b.half_m.z());
  const Material rim = metal(b);
  b.add(ConeShell{outer_m, outer_m, high}, rim, at, along(end * Vector3::UnitZ()));
  b.add(FlatRing{0.85 * outer_m, outer_m}, rim, at + Vector3(0.0, 0.0, end * high));
}

void add_part(Builder& b, void (*make)(Builder&)) {
  const std::size_t from = b.body.scene.solids.size();
  make(b);
  b.finish_part(from);
}

void add_parts(Builder& b) {
  add_bus(b);
  add_wings(b);
  if (b.random.chance(0.6)) add_ring(b);
  if (b.random.chance(0.5)) add_part(b, add_dish);
  if (b.random.chance(0.5)) add_part(b, add_mast);
  const int covers = 1 + b.random.below(5), thrusters = b.random.below(4);
  for (int k = 0; k < covers; ++k) add_part(b, add_cover);
  for (int k = 0; k < thrusters; ++k) add_part(b, add_thruster);
}

Vector3 random_direction(Builder& b) {
  return Vector3(b.random.normal(), b.random.normal(), b.random.normal()).normalized();
}

}  // namespace

RandomBody random_body(std::uint64_t seed) {
  Builder b{RandomStream(seed, "random body"), {}};
  b.body.symmetric = seed % 2 == 0;
  add_parts(b);
  RandomBody& body = b.body;
  body.reach_m = 0.0;
  for (const Solid& solid : body.scene.solids) {
    const Bounds bounds = bounds_of(solid);
    body.reach_m = std::max(body.reach_m, (solid.R * bounds.centre_m + solid.t_m).norm() + bounds.radius_m);
  }
  body.spin_axis_body = random_direction(b);
  body.R_rig_body = along(random_direction(b)) * rotation_exp(Vector3(0.0, 0.0, b.between(0.0, kTurn_rad)));
  const double phase = b.between(0.1, 1.2), turn = b.between(0.0, kTurn_rad);
  body.to_sun_rig = {std::sin(phase) * std::cos(turn), std::sin(phase) * std::sin(turn), -std::cos(phase)};
  body.fill = 0.02 * std::pow(20.0, b.between(0.0, 1.0));
  body.scene.sun_radius_rad = b.random.chance(0.6) ? 0.0 : b.between(0.02, 0.15);
  return body;
}

}  // namespace pharos::sim
