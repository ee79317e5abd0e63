// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "tools/sim/povray/scene_text.hpp"
#include "tools/sim/ring2/ring2_scenario.hpp"

namespace pharos::sim {
namespace {

// Fractions of the ring's radius.
constexpr double kRingInner = 0.93;
constexpr double kRingHeight = 0.16;
constexpr double kBodyHalf = 1.45;
constexpr double kBodyDepth = 2.0;
// Of the exit radius: the stiffening rim around the exit, and the throat.
constexpr double kLip = 0.12;
constexpr double kThroat = 0.35;

// The target's own frame: z along the normal, the ring's front plane at z = 0.
std::string placing_of(const RingAndNozzle& target) {
  const Vector3 helper = std::abs(target.normal.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 x = (helper - helper.dot(target.normal) * target.normal).normalized();
  const Vector3 y = target.normal.cross(x);
  std::string text;
  for (const Vector3& row : {x, y, target.normal, target.ring_centre_m}) {
    const std::string vector = povray_vector(row);  // "<a, b, c>"
    text += (text.empty() ? "" : ", ") + vector.substr(1, vector.size() - 2);
  }
  return "matrix <" + text + ">";
}

std::string ring_text(double radius_m) {
  const double height = kRingHeight * radius_m;
  return fmt::format(
      "difference {{ cylinder {{ <0, 0, {0}>, <0, 0, 0>, {1} }} cylinder {{ <0, 0, {2}>, <0, 0, 0.01>, {3} }}\n"
      "  pigment {{ rgb 0.55 }} finish {{ diffuse 0.8 specular 0.15 roughness 0.05 }} }}\n",
      -height, radius_m, -2.0 * height, kRingInner * radius_m);
}

std::string nozzle_text(const RingAndNozzle& target) {
  const double exit = target.nozzle_radius_m;
  const double lip = (1.0 - kLip) * exit;
  const double foot = -kRingHeight * target.ring_radius_m;
  const double top = target.distance_m;
  return fmt::format(
      "difference {{ cone {{ <0, 0, {0}>, {1}, <0, 0, {2}>, {3} }} cone {{ <0, 0, {4}>, {5}, <0, 0, {6}>, {7} }}\n"
      "  pigment {{ rgb 0.42 }} finish {{ diffuse 0.7 specular 0.2 roughness 0.1 }} }}\n",
      foot, kThroat * exit, top, exit, foot + 0.02, kThroat * lip, top + 1e-4, lip);
}

std::string body_text(double radius_m) {
  const double half = kBodyHalf * radius_m;
  const double front = -kRingHeight * radius_m;
  return fmt::format(
      "box {{ <{0}, {0}, {1}>, <{2}, {2}, {3}>\n"
      "  pigment {{ rgb <0.30, 0.30, 0.30> }} normal {{ crackle 0.5 scale {4} }}\n"
      "  finish {{ diffuse 0.5 specular 0.5 roughness 0.01 }} }}\n",
      -half, front - kBodyDepth * radius_m, half, front, 0.16 * radius_m);
}

std::string lights_text(const Ring2Scenario& scenario) {
  const Vector3 far = 1000.0 * scenario.sun_direction;
  return "light_source { " + povray_vector(far) + " rgb 1.0 parallel point_at <0, 0, 0> }\n" +
         fmt::format("light_source {{ <0, 0, 0> rgb {} shadowless }}\n", scenario.fill_light);
}

}  // namespace

std::string ring2_scene_text(const Ring2Scenario& scenario, std::size_t pair, std::size_t view) {
  const StereoCamera& camera = scenario.rig[view];
  const RingAndNozzle target = scenario.target_at(pair);
  return povray_preamble() + povray_camera(camera, camera.R_rig_camera, camera.t_rig_camera_m) + lights_text(scenario) +
         "union {\n" + ring_text(target.ring_radius_m) + nozzle_text(target) + body_text(target.ring_radius_m) +
         placing_of(target) + "\n}\n";
}

}  // namespace pharos::sim
