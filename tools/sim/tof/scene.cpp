// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/scene.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/sim/render/primitives.hpp"
#include "tools/sim/render/solid_shapes.hpp"

namespace pharos::sim {
namespace {

constexpr double kMultipathDecay_m = 0.08;  // how far from a corner the light that came round it still counts
constexpr int kFacesOfConnector = 3;        // and of clutter: edges between faces are worth more rays

int number_of(SurfaceKind kind) { return static_cast<int>(kind); }

double multipath_path(double distance_m) { return distance_m * std::exp(-distance_m / kMultipathDecay_m); }

double across_of(const Connector& connector) {
  return connector.across_m > 0.0 ? connector.across_m : connector.side_m;
}

double power_of_two(double base, int squarings) {
  for (int i = 0; i < squarings; ++i) base *= base;
  return base;
}

}  // namespace

Scene::Scene(const Satellite& satellite, const FoilTexture& foil, const CameraFromTarget& T_camera_target)
    : satellite_(satellite),
      foil_(foil),
      T_camera_target_(T_camera_target),
      camera_T_(T_camera_target.inverse() * Vector3::Zero()) {
  double reach = 0.0;
  double low = satellite.face_z_m;
  double high = 0.0;
  if (satellite.ring) reach = satellite.ring->outer_radius_m;
  if (satellite.nozzle) {
    const Nozzle& n = *satellite.nozzle;
    reach = std::max(reach, n.exit_radius_m);
    high = std::max(high, n.exit_z_m);
    low = std::min(low, n.throat_z_m);
    hole_radius_m_ =
        std::max(0.0, n.exit_radius_m + (n.throat_radius_m - n.exit_radius_m) * (n.exit_z_m - satellite.face_z_m) /
                                            (n.exit_z_m - n.throat_z_m));
  }
  const double middle = 0.5 * (low + high);
  balls_.push_back({T_camera_target * Vector3(0, 0, middle), std::hypot(reach, 0.5 * (high - low))});
  for (const Connector& c : satellite.connectors) {
    const double angle = c.direction_deg * kRadPerDeg;
    Eigen::Matrix2d axes;
    axes << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    const Vector2 centre = axes.transpose() * Vector2(c.distance_m, 0.0);
    const double own = angle + c.turn_deg * kRadPerDeg;
    axes << std::cos(own), std::sin(own), -std::sin(own), std::cos(own);
    connector_axes_.push_back(axes);
    connector_centres_.push_back(centre);
    const Vector3 middle_T(centre.x(), centre.y(), satellite.face_z_m + 0.5 * c.height_m);
    balls_.push_back({T_camera_target * middle_T, 0.5 * std::hypot(c.side_m, across_of(c), c.height_m)});
  }
  for (const Solid& solid : satellite.clutter) {
    const Bounds bounds = bounds_of(solid);
    balls_.push_back({T_camera_target * (solid.R * bounds.centre_m + solid.t_m), bounds.radius_m});
  }
  if (satellite.occluder && satellite.ring) place_boom(*satellite.occluder);
}

void Scene::place_boom(const Occluder& occluder) {
  const double radius = satellite_.ring->outer_radius_m;
  const auto seen = [&](double turn_deg) -> Vector2 {
    const double angle = (occluder.direction_deg + turn_deg) * kRadPerDeg;
    const Vector3 p = T_camera_target_ * Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    return p.head<2>() / p.z();
  };
  const double half_deg = 180.0 * occluder.fraction;
  const Vector2 one = seen(-half_deg);
  const Vector2 along = (seen(half_deg) - one).normalized();
  boom_.normal = Vector2(-along.y(), along.x());
  if (boom_.normal.dot(seen(0.0) - one) < 0.0) boom_.normal = -boom_.normal;
  boom_.edge = boom_.normal.dot(one);
  boom_.width = occluder.width_m / T_camera_target_.t.z();
  boom_.depth_m = occluder.nearness * T_camera_target_.t.z();
}

Scene::Parts Scene::parts_near(const Vector3& direction, double half_angle_rad) const {
  Parts parts = 0;
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    const double distance = balls_[i].centre_camera_m.norm();
    const double apart = std::acos(std::clamp(direction.dot(balls_[i].centre_camera_m) / distance, -1.0, 1.0));
    const double reach = std::asin(std::min(1.0, balls_[i].radius_m / distance));
    if (apart < reach + half_angle_rad) parts |= Parts{1} << i;
  }
  return parts;
}

Hit Scene::trace(const Vector2& ray, Parts parts) const {
  const Vector3 seen(ray.x(), ray.y(), 1.0);
  if (boom_.width > 0.0) {
    const double inside = boom_.normal.dot(ray) - boom_.edge;
    if (inside > 0.0 && inside < boom_.width) {
      return {boom_.depth_m, satellite_.occluder->albedo / seen.norm(), 0.0, number_of(SurfaceKind::kOccluder)};
    }
  }
  Ray in_T;
  in_T.direction = T_camera_target_.R.transpose() * seen;
  in_T.to_camera = -in_T.direction.normalized();
  Hit hit;
  hit.depth_m = kNever;
  trace_body(in_T, hit);
  if ((parts & 1u) != 0) {
    if (satellite_.ring) trace_ring(in_T, hit);
    if (satellite_.nozzle) trace_nozzle(in_T, hit);
  }
  for (std::size_t i = 0; i < satellite_.connectors.size(); ++i) {
    if ((parts >> (i + 1) & 1u) != 0) trace_connector(in_T, i, hit);
  }
  const std::size_t before = 1 + satellite_.connectors.size();
  for (std::size_t i = 0; i < satellite_.clutter.size(); ++i) {
    if ((parts >> (before + i) & 1u) != 0) trace_clutter(in_T, i, hit);
  }
  if (hit.surface == number_of(SurfaceKind::kFace)) shade_face(in_T, hit);
  return hit;
}

double Scene::glossy(const Vector3& normal, const Ray& ray) const {
  const Foil& foil = satellite_.foil;
  const double cosine = std::max(0.0, normal.dot(ray.to_camera));
  const double broad = power_of_two(cosine, 5);
  return foil.albedo * cosine + foil.gloss * broad + foil.glint * power_of_two(broad, 5);
}

void Scene::trace_body(const Ray& ray, Hit& hit) const {
  const Vector3 half(0.5 * satellite_.body_x_m, 0.5 * satellite_.body_y_m, 0.0);
  const Vector3 low(-half.x(), -half.y(), satellite_.face_z_m - satellite_.body_depth_m);
  const Vector3 high(half.x(), half.y(), satellite_.face_z_m);
  const BoxEntry entry = enter_box(camera_T_, ray.direction, low, high);
  if (entry.at == kNever) return;
  const Vector3 p = camera_T_ + entry.at * ray.direction;
  if (entry.axis == 2 && ray.direction.z() < 0.0) {
    if (p.head<2>().squaredNorm() < hole_radius_m_ * hole_radius_m_) return;
    hit.depth_m = entry.at;
    hit.surface = number_of(SurfaceKind::kFace);  // shaded when it is known to be seen
    return;
  }
  const bool back = entry.axis == 2;
  const int across = entry.axis == 0 ? 1 : 0;
  const int along = back ? 1 : 2;
  const FoilTexture::Wrinkle wrinkle = foil_.at(p[across] + 0.7, p[along] + 0.3);
  Vector3 normal = Vector3::Zero();
  const double side = ray.direction[entry.axis] < 0.0 ? 1.0 : -1.0;
  normal[entry.axis] = side;
  normal[across] = -wrinkle.slope_x;
  normal[along] = -wrinkle.slope_y;
  hit.depth_m = entry.at + side * wrinkle.height_m / ray.direction[entry.axis];
  hit.reflectance = glossy(normal.normalized(), ray);
  hit.surface = number_of(back ? SurfaceKind::kBack : entry.axis == 0 ? SurfaceKind::kSideX : SurfaceKind::kSideY);
}

void Scene::shade_face(const Ray& ray, Hit& hit) const {
  const Vector3 p = camera_T_ + hit.depth_m * ray.direction;
  const FoilTexture::Wrinkle wrinkle = foil_.at(p.x(), p.y());
  const Vector3 normal = Vector3(-wrinkle.slope_x, -wrinkle.slope_y, 1.0).normalized();
  hit.depth_m += wrinkle.height_m / ray.direction.z();
  hit.reflectance = glossy(normal, ray);
  for (const PaintedCircle& circle : satellite_.circles) {
    const double off = std::hypot(p.x() - circle.x_m, p.y() - circle.y_m) - circle.radius_m;
    if (std::abs(off) < 0.5 * circle.line_m) {
      hit.reflectance = circle.albedo * std::max(0.0, normal.dot(ray.to_camera));
      hit.surface = number_of(SurfaceKind::kPaint);
    }
  }
  if (satellite_.ring) {
    const double to_wall = satellite_.ring->inner_radius_m - p.head<2>().norm();
    if (to_wall > 0.0) hit.multipath_m = multipath_path(to_wall);
  }
}

void Scene::trace_ring(const Ray& ray, Hit& hit) const {
  const Ring& ring = *satellite_.ring;
  const Vector3& d = ray.direction;
  const double front = meet_level(camera_T_, d, 0.0);
  const double radius2 = (camera_T_ + front * d).head<2>().squaredNorm();
  if (front > 0.0 && front < hit.depth_m && radius2 <= ring.outer_radius_m * ring.outer_radius_m &&
      radius2 >= ring.inner_radius_m * ring.inner_radius_m) {
    hit = {front, ring.albedo * std::abs(ray.to_camera.z()), 0.0, number_of(SurfaceKind::kRingFront)};
    return;
  }
  const auto wall = [&](double at, double radius, bool inside) {
    const Vector3 p = camera_T_ + at * d;
    if (at <= 0.0 || at >= hit.depth_m || p.z() > 0.0 || p.z() < satellite_.face_z_m) return;
    const double cosine = std::abs(p.head<2>().dot(ray.to_camera.head<2>())) / radius;
    hit = {at, ring.albedo * cosine, inside ? multipath_path(p.z() - satellite_.face_z_m) : 0.0,
           number_of(inside ? SurfaceKind::kRingInside : SurfaceKind::kRingOutside)};
  };
  wall(meet_cone(camera_T_, d, ring.outer_radius_m, 0.0, 0.0)[0], ring.outer_radius_m, false);
  wall(meet_cone(camera_T_, d, ring.inner_radius_m, 0.0, 0.0)[1], ring.inner_radius_m, true);
}

void Scene::trace_nozzle(const Ray& ray, Hit& hit) const {
  const Nozzle& nozzle = *satellite_.nozzle;
  const Vector3& d = ray.direction;
  const double slope = (nozzle.exit_radius_m - nozzle.throat_radius_m) / (nozzle.exit_z_m - nozzle.throat_z_m);
  for (const double at : meet_cone(camera_T_, d, nozzle.exit_radius_m, slope, nozzle.exit_z_m)) {
    if (at <= 0.0 || at >= hit.depth_m) continue;
    const Vector3 p = camera_T_ + at * d;
    if (p.z() > nozzle.exit_z_m || p.z() < nozzle.throat_z_m) continue;
    const double radius = p.head<2>().norm();
    const Vector3 outward = Vector3(p.x() / radius, p.y() / radius, -slope).normalized();
    const double facing = outward.dot(ray.to_camera);
    const bool inside = facing < 0.0;
    // The outside beneath the face is within the body: only the hole shows what lies deeper.
    if (!inside && p.z() < satellite_.face_z_m) continue;
    hit = {at, nozzle.albedo * std::abs(facing), inside ? 0.5 * radius : 0.0,
           number_of(inside ? SurfaceKind::kNozzleInside : SurfaceKind::kNozzleOutside)};
    return;
  }
  const double at = meet_level(camera_T_, d, nozzle.throat_z_m);
  if (at > 0.0 && at < hit.depth_m &&
      (camera_T_ + at * d).head<2>().squaredNorm() < nozzle.throat_radius_m * nozzle.throat_radius_m) {
    hit = {at, 0.3 * nozzle.albedo * std::abs(ray.to_camera.z()), nozzle.throat_radius_m,
           number_of(SurfaceKind::kThroat)};
  }
}

void Scene::trace_connector(const Ray& ray, std::size_t number, Hit& hit) const {
  const Connector& connector = satellite_.connectors[number];
  const Eigen::Matrix2d& axes = connector_axes_[number];
  Vector3 o = camera_T_;
  Vector3 d = ray.direction;
  o.head<2>() = axes * (camera_T_.head<2>() - connector_centres_[number]);
  d.head<2>() = axes * ray.direction.head<2>();
  const double half = 0.5 * connector.side_m, other = 0.5 * across_of(connector);
  const BoxEntry entry =
      enter_box(o, d, {-half, -other, satellite_.face_z_m}, {half, other, satellite_.face_z_m + connector.height_m});
  if (entry.at >= hit.depth_m) return;
  hit = {entry.at, connector.albedo * std::abs(d[entry.axis]) / d.norm(), 0.0,
         number_of(SurfaceKind::kConnector) + static_cast<int>(number) * kFacesOfConnector + entry.axis};
}

int Scene::top_of_connector(std::size_t number) {
  return number_of(SurfaceKind::kConnector) + static_cast<int>(number) * kFacesOfConnector + 2;
}

void Scene::trace_clutter(const Ray& ray, std::size_t number, Hit& hit) const {
  const Solid& solid = satellite_.clutter[number];
  const Vector3 o = solid.R.transpose() * (camera_T_ - solid.t_m), d = solid.R.transpose() * ray.direction;
  const SolidHit met = std::visit([&](const auto& shape) { return meet(shape, o, d, 0.0); }, solid.shape);
  if (met.depth >= hit.depth_m) return;
  int face = 0;
  met.normal.cwiseAbs().maxCoeff(&face);
  const std::size_t of_connectors = satellite_.connectors.size() + number;
  hit = {met.depth, solid.material.albedo * std::abs(met.normal.dot(d)) / d.norm(), 0.0,
         number_of(SurfaceKind::kConnector) + static_cast<int>(of_connectors) * kFacesOfConnector +
             (std::holds_alternative<SolidBox>(solid.shape) ? face : 0)};
}

}  // namespace pharos::sim
