// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/random_clutter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

// Of a second ring: from here on it may as well be the docking ring.
constexpr double kDockingRadius_m = 0.24;
// Between two things on the face.
constexpr double kClear_m = 0.02;

double reach_of(const Connector& box) { return 0.5 * std::hypot(box.side_m, std::max(box.across_m, box.side_m)); }

class Clutter {
 public:
  Clutter(RandomTofBody& body, RandomStream random)
      : body_(body), satellite_(body.scenario.satellite), ring_(*satellite_.ring), random_(random) {}

  void add() {
    if (random_.chance(0.25)) add_second_ring(random_.uniform(0.08, 0.2));
    if (random_.chance(0.03)) add_second_ring(random_.uniform(0.25, 0.4));
    if (random_.chance(0.2)) add_groove();
    if (random_.chance(0.25)) add_square_cover();
    if (random_.chance(0.4)) add_thrusters();
    if (random_.chance(0.3)) add_dish();
    if (random_.chance(0.08)) add_boom();
  }

 private:
  std::optional<Vector2> free_place(double reach_m) {
    for (int draw = 0; draw < 60; ++draw) {
      const Vector2 place(0.5 * satellite_.body_x_m * random_.uniform(-1.0, 1.0),
                          0.5 * satellite_.body_y_m * random_.uniform(-1.0, 1.0));
      if (is_free(satellite_, place, reach_m)) return place;
    }
    return std::nullopt;
  }

  void put(std::variant<SolidBox, FlatRing, ConeShell, Dish> shape, double albedo, const Vector3& at,
           const Matrix3& R = Matrix3::Identity()) {
    satellite_.clutter.push_back({shape, Material{albedo}, R, at});
  }

  void add_second_ring(double radius) {
    const auto place = free_place(radius + kClear_m);
    if (!place) return;
    const double inner = radius * random_.uniform(0.75, 0.94), height = random_.uniform(0.01, 0.1);
    const double albedo = random_.uniform(0.3, 0.6);
    const Vector3 foot(place->x(), place->y(), satellite_.face_z_m);
    put(FlatRing{inner, radius}, albedo, foot + Vector3(0.0, 0.0, height));
    put(ConeShell{radius, radius, height}, albedo, foot);
    put(ConeShell{inner, inner, height}, albedo, foot);
    (radius > kDockingRadius_m ? body_.has_twin : body_.has_look_alike) = true;
  }

  // Flat on the face, inside of the ring.
  void add_groove() {
    const double radius = random_.uniform(0.6, 0.9) * ring_.inner_radius_m;
    put(FlatRing{radius * random_.uniform(0.9, 0.97), radius}, random_.uniform(0.3, 0.6),
        {0.0, 0.0, satellite_.face_z_m + 0.002});
  }

  void add_square_cover() {
    // Of a connector's shape but not of its size.
    const double side = satellite_.connectors[0].side_m * random_.uniform(1.5, 3.0);
    const auto place = free_place(0.71 * side + kClear_m);
    if (!place) return;
    const double half = 0.5 * side, angle = random_.uniform(0.0, 2.0 * std::numbers::pi);
    put(SolidBox{{-half, -half, 0.0}, {half, half, random_.uniform(0.02, 0.1)}}, random_.uniform(0.15, 0.6),
        {place->x(), place->y(), satellite_.face_z_m}, Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix());
    body_.has_look_alike = true;
  }

  void add_thrusters() {
    const double exit = random_.uniform(0.02, 0.06), length = random_.uniform(0.04, 0.15);
    const double albedo = random_.uniform(0.2, 0.5);
    for (int k = 0; k < 3; ++k) {
      const auto place = free_place(exit + kClear_m);
      if (!place) return;
      const Vector3 foot(place->x(), place->y(), satellite_.face_z_m);
      put(ConeShell{0.4 * exit, exit, length}, albedo, foot);
      body_.has_look_alike = true;
    }
  }

  void add_dish() {
    const double radius = random_.uniform(0.2, 0.6), from = random_.uniform(-0.5, 0.7) * radius;
    const double half_m = 0.5 * std::max(satellite_.body_x_m, satellite_.body_y_m);
    const double angle = random_.uniform(0.0, 2.0 * std::numbers::pi), away = 1.2 * half_m + radius;
    put(Dish{radius, from}, random_.uniform(0.3, 0.6),
        {away * std::cos(angle), away * std::sin(angle), satellite_.face_z_m - random_.uniform(0.0, 1.0) * radius});
  }

  // Across the whole face, above it.
  void add_boom() {
    const double radius = random_.uniform(0.008, 0.03), angle = random_.uniform(0.0, 2.0 * std::numbers::pi);
    const Vector3 along(std::cos(angle), std::sin(angle), 0.0), across(-std::sin(angle), std::cos(angle), 0.0);
    Matrix3 R;  // its z along the face
    R << Vector3::UnitZ(), along.cross(Vector3::UnitZ()), along;
    const double length = 1.5 * std::max(satellite_.body_x_m, satellite_.body_y_m);
    put(ConeShell{radius, radius, length}, random_.uniform(0.3, 0.6),
        random_.uniform(-1.0, 1.0) * ring_.outer_radius_m * across - 0.5 * length * along +
            Vector3(0.0, 0.0, random_.uniform(0.1, 0.5)),
        R);
  }

  RandomTofBody& body_;
  Satellite& satellite_;
  const Ring& ring_;
  RandomStream random_;
};

}  // namespace

Vector2 place_of(const Connector& box) {
  const double angle = box.direction_deg * kRadPerDeg;
  return box.distance_m * Vector2(std::cos(angle), std::sin(angle));
}

bool is_free(const Satellite& satellite, const Vector2& place_m, double reach_m) {
  if (std::abs(place_m.x()) + reach_m > 0.5 * satellite.body_x_m ||
      std::abs(place_m.y()) + reach_m > 0.5 * satellite.body_y_m) {
    return false;
  }
  const double distance = place_m.norm();
  if (satellite.ring && distance + reach_m > satellite.ring->inner_radius_m &&
      distance - reach_m < satellite.ring->outer_radius_m) {
    return false;
  }
  if (satellite.nozzle && distance - reach_m < satellite.nozzle->exit_radius_m) return false;
  for (const Connector& box : satellite.connectors) {
    if ((place_m - place_of(box)).norm() < reach_m + reach_of(box)) return false;
  }
  return std::none_of(satellite.clutter.begin(), satellite.clutter.end(), [&](const Solid& solid) {
    const auto* tube = std::get_if<ConeShell>(&solid.shape);
    const auto* box = std::get_if<SolidBox>(&solid.shape);
    const auto* ring = std::get_if<FlatRing>(&solid.shape);
    const double reach = tube   ? std::max(tube->first_m, tube->last_m)
                         : box  ? box->high.head<2>().norm()
                         : ring ? ring->outer_m
                                : 0.0;
    const double apart = (place_m - solid.t_m.head<2>()).norm();
    // A groove is flat, and about the same axis.
    return !(ring && solid.t_m.head<2>().norm() == 0.0) && apart < reach_m + reach;
  });
}

void add_clutter(RandomTofBody& body, RandomStream random) { Clutter(body, random).add(); }

}  // namespace pharos::sim
