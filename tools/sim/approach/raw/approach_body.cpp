// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/raw/approach_body.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

constexpr double kRingDiameter_m = 1.1;
// The lighthouse's target: sensors within 0.055 m of its axis and up to 0.0625 m above its origin (target12.csv).
constexpr double kHeadFoot_m = 0.07, kHeadTop_m = 0.035, kHeadHeight_m = 0.12;
constexpr double kHoleAlbedo = 0.03;

Material foil(std::uint32_t pattern) {
  Material out{0.35, 0.3};
  out.bumps = 0.3;
  out.bump_size_m = 0.08;
  out.pattern = pattern;
  out.paint_contrast = 0.35;
  return out;
}

Material metal(double albedo, std::uint32_t pattern) {
  Material out{albedo, 0.1};
  out.pattern = pattern;
  return out;
}

Material solar_cells(std::uint32_t pattern) {
  Material out{0.18, 0.1};
  out.cell_m = {0.16, 0.12};
  out.line_m = 0.012;
  out.line_albedo = 0.55;
  out.paint_contrast = 0.35;
  out.pattern = pattern;
  return out;
}

void add_clutter(Satellite& satellite, const Pose<frame::Target, frame::Body>& head) {
  const double half_m = 0.5 * satellite.body_x_m, face_m = satellite.face_z_m;
  const auto add = [&](const SolidBox& box, const Material& material, const Matrix3& R, const Vector3& at) {
    satellite.clutter.push_back({box, material, R, at});
  };
  const Matrix3 upright = Matrix3::Identity();
  std::uint32_t pattern = 20;
  for (const double side : {-1.0, 1.0}) {
    const double low = side > 0.0 ? half_m + 0.25 : -half_m - 1.65;
    add({{low, -0.5, -0.015}, {low + 1.4, 0.5, 0.015}}, solar_cells(++pattern), upright, {0.0, 0.0, face_m - 0.5});
  }
  // Round, as no connector is: which of three like boxes are the connectors nobody could tell.
  satellite.clutter.push_back({ConeShell{kHeadFoot_m, kHeadTop_m, kHeadHeight_m}, metal(0.3, ++pattern), head.R,
                               head.t + head.R * Vector3(0.0, 0.0, face_m)});
}

void add_ring(SolidScene& scene, const Ring& ring, double face_m) {
  const Material material = metal(ring.albedo, 2);
  const Vector3 foot(0.0, 0.0, face_m);
  scene.solids.push_back({FlatRing{ring.inner_radius_m, ring.outer_radius_m}, material});
  for (const double radius_m : {ring.outer_radius_m, ring.inner_radius_m}) {
    scene.solids.push_back({ConeShell{radius_m, radius_m, -face_m}, material, Matrix3::Identity(), foot});
  }
}

// From the face to its exit; below the face it is dark.
void add_nozzle(SolidScene& scene, const Nozzle& nozzle, double face_m) {
  const double slope = (nozzle.exit_radius_m - nozzle.throat_radius_m) / (nozzle.exit_z_m - nozzle.throat_z_m);
  const double foot_radius_m = nozzle.exit_radius_m - slope * (nozzle.exit_z_m - face_m);
  const Matrix3 upright = Matrix3::Identity();
  scene.solids.push_back({ConeShell{foot_radius_m, nozzle.exit_radius_m, nozzle.exit_z_m - face_m},
                          metal(nozzle.albedo, 3), upright, Vector3(0.0, 0.0, face_m)});
  scene.solids.push_back(
      {FlatRing{0.0, foot_radius_m}, Material{kHoleAlbedo}, upright, Vector3(0.0, 0.0, face_m + 1e-3)});
}

void add_connector(SolidScene& scene, const Connector& connector, double face_m, std::uint32_t pattern) {
  const double direction = connector.direction_deg * kRadPerDeg;
  const double along = 0.5 * connector.side_m;
  const double across = connector.across_m > 0.0 ? 0.5 * connector.across_m : along;
  scene.solids.push_back(
      {SolidBox{{-along, -across, 0.0}, {along, across, connector.height_m}}, metal(connector.albedo, pattern),
       rotation_exp({0.0, 0.0, direction + connector.turn_deg * kRadPerDeg}),
       Vector3(connector.distance_m * std::cos(direction), connector.distance_m * std::sin(direction), face_m)});
}

}  // namespace

Satellite approach_satellite(const Pose<frame::Target, frame::Body>& head) {
  Satellite satellite = satellite_of_ring(kRingDiameter_m);
  // As deep as in paper 001 relative to its ring's diameter: two views tell its attitude by it.
  satellite.nozzle->exit_radius_m = 0.16;
  satellite.nozzle->exit_z_m = 0.25;
  add_clutter(satellite, head);
  return satellite;
}

SolidScene sunlit_scene(const Satellite& satellite) {
  SolidScene scene;
  const Vector3 half(0.5 * satellite.body_x_m, 0.5 * satellite.body_y_m, 0.0);
  const double face_m = satellite.face_z_m;
  scene.solids.push_back(
      {SolidBox{{-half.x(), -half.y(), face_m - satellite.body_depth_m}, {half.x(), half.y(), face_m}}, foil(1)});
  if (satellite.ring) add_ring(scene, *satellite.ring, face_m);
  if (satellite.nozzle) add_nozzle(scene, *satellite.nozzle, face_m);
  std::uint32_t pattern = 10;
  for (const Connector& connector : satellite.connectors) add_connector(scene, connector, face_m, ++pattern);
  scene.solids.insert(scene.solids.end(), satellite.clutter.begin(), satellite.clutter.end());
  return scene;
}

}  // namespace pharos::sim
