// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/render/solid_shapes.hpp"

namespace pharos::sim {

SolidHit meet(const SolidBox& box, const Vector3& origin, const Vector3& direction, double nearest) {
  const BoxEntry entry = enter_box(origin, direction, box.low, box.high);
  SolidHit hit;
  if (!(entry.at > nearest) || entry.at == kNever) return hit;
  hit.depth = entry.at;
  hit.normal = Vector3::Unit(entry.axis);
  hit.face = 2 * entry.axis + (direction[entry.axis] > 0.0 ? 0 : 1);
  const Vector3 place = origin + entry.at * direction - box.low;
  hit.place_m = {place[(entry.axis + 1) % 3], place[(entry.axis + 2) % 3]};
  if (entry.axis == 1) hit.place_m = {hit.place_m.y(), hit.place_m.x()};  // x before z, as x before y elsewhere
  return hit;
}

SolidHit meet(const FlatRing& ring, const Vector3& origin, const Vector3& direction, double nearest) {
  const double depth = meet_level(origin, direction, 0.0);
  SolidHit hit;
  if (!(depth > nearest)) return hit;
  const Vector3 place = origin + depth * direction;
  const double square = place.head<2>().squaredNorm();
  if (square > ring.outer_m * ring.outer_m || square < ring.inner_m * ring.inner_m) return hit;
  hit.depth = depth;
  hit.place_m = place.head<2>();
  return hit;
}

SolidHit meet(const ConeShell& cone, const Vector3& origin, const Vector3& direction, double nearest) {
  const double slope = (cone.last_m - cone.first_m) / cone.length_m;
  for (const double depth : meet_cone(origin, direction, cone.first_m, slope, 0.0)) {
    if (!(depth > nearest) || depth == kNever) continue;
    const Vector3 place = origin + depth * direction;
    if (place.z() < 0.0 || place.z() > cone.length_m) continue;
    const double radius = place.head<2>().norm();
    return {depth,
            Vector3(place.x() / radius, place.y() / radius, -slope).normalized(),
            {radius * std::atan2(place.y(), place.x()), place.z()},
            0};
  }
  return {};
}

SolidHit meet(const Dish& dish, const Vector3& origin, const Vector3& direction, double nearest) {
  const double a = direction.squaredNorm(), b = origin.dot(direction);
  const double c = origin.squaredNorm() - dish.radius_m * dish.radius_m;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return {};
  const double root = std::sqrt(discriminant);
  for (const double depth : {(-b - root) / a, (-b + root) / a}) {
    const Vector3 place = origin + depth * direction;
    if (!(depth > nearest) || place.z() < dish.from_m) continue;
    return {depth, place.normalized(), place.head<2>(), 0};
  }
  return {};
}

Bounds bounds_of(const Solid& solid) {
  if (const auto* box = std::get_if<SolidBox>(&solid.shape)) {
    return {0.5 * (box->low + box->high), 0.5 * (box->high - box->low).norm()};
  }
  if (const auto* ring = std::get_if<FlatRing>(&solid.shape)) return {Vector3::Zero(), ring->outer_m};
  if (const auto* cone = std::get_if<ConeShell>(&solid.shape)) {
    const double half = 0.5 * cone->length_m;
    return {{0.0, 0.0, half}, std::hypot(half, std::max(cone->first_m, cone->last_m))};
  }
  const auto& dish = std::get<Dish>(solid.shape);
  if (dish.from_m <= 0.0) return {Vector3::Zero(), dish.radius_m};
  const double rim = std::sqrt(dish.radius_m * dish.radius_m - dish.from_m * dish.from_m);
  return {{0.0, 0.0, dish.from_m}, std::max(rim, dish.radius_m - dish.from_m)};
}

}  // namespace pharos::sim
