// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ring2/random_target.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/ring2/projected_ellipse.hpp"

namespace pharos::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// The target's own frame: z along the normal, the ring's front plane at z = 0.
struct Frame {
  Matrix3 R = Matrix3::Identity();
  Vector3 t_m = Vector3::Zero();
};

struct Builder {
  RandomStream random;
  Frame frame;
  SolidScene scene;

  void add(const std::variant<SolidBox, FlatRing, ConeShell, Dish>& shape, const Material& material, const Vector3& at,
           const Matrix3& R = Matrix3::Identity()) {
    scene.solids.push_back({shape, material, frame.R * R, frame.R * at + frame.t_m});
  }
  double between(double low, double high) { return random.uniform(low, high); }
  double sign() { return random.chance(0.5) ? 1.0 : -1.0; }
};

Frame frame_of(const RingAndNozzle& truth, double roll_rad) {
  const Vector3 helper = std::abs(truth.normal.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 x = (helper - helper.dot(truth.normal) * truth.normal).normalized();
  const Vector3 y = truth.normal.cross(x);
  Frame frame;
  frame.R.col(0) = std::cos(roll_rad) * x + std::sin(roll_rad) * y;
  frame.R.col(1) = truth.normal.cross(frame.R.col(0));
  frame.R.col(2) = truth.normal;
  frame.t_m = truth.ring_centre_m;
  return frame;
}

// A face between two circles with walls behind it; centre of the face at `at`.
void add_ring(Builder& b, double outer_m, double width, double height_m, const Vector3& at, const Material& metal) {
  const double inner_m = outer_m * (1.0 - width);
  b.add(FlatRing{inner_m, outer_m}, metal, at);
  const Vector3 foot = at - Vector3(0.0, 0.0, height_m);
  b.add(ConeShell{outer_m, outer_m, height_m}, metal, foot);
  b.add(ConeShell{inner_m, inner_m, height_m}, metal, foot);
}

// From `foot` along z; the exit is a lip between two circles.
void add_nozzle(Builder& b, double exit_m, double lip, double length_m, const Vector3& foot, const Material& metal) {
  const double inner_m = exit_m * (1.0 - lip), throat = b.between(0.25, 0.6);
  b.add(ConeShell{throat * exit_m, exit_m, length_m}, metal, foot);
  b.add(ConeShell{throat * inner_m, inner_m, length_m}, metal, foot);
  b.add(FlatRing{inner_m, exit_m}, metal, foot + Vector3(0.0, 0.0, length_m));
}

void add_wings(Builder& b, double half_m, double front_m) {
  Material cells{b.between(0.05, 0.4)};
  cells.cell_m = {b.between(0.1, 0.4), b.between(0.1, 0.4)};
  cells.line_m = b.between(0.005, 0.02);
  cells.line_albedo = b.between(0.3, 0.8);
  const double length_m = b.between(1.5, 5.0), width_m = b.between(0.5, 1.0) * 2.0 * half_m;
  const double gap_m = b.between(0.05, 0.4), turn = b.between(-0.8, 0.8),
               depth_m = front_m - b.between(0.3, 1.0) * half_m;
  Matrix3 R = Matrix3::Identity();
  R(1, 1) = R(2, 2) = std::cos(turn);
  R(1, 2) = -(R(2, 1) = std::sin(turn));
  for (const double side : {-1.0, 1.0}) {
    const double from = half_m + gap_m;
    const double low = side > 0.0 ? from : -from - length_m;
    b.add(SolidBox{{low, -0.5 * width_m, -0.01}, {low + length_m, 0.5 * width_m, 0.01}}, cells, {0.0, 0.0, depth_m}, R);
  }
}

// What looks like the feature, or stands before it.
void add_clutter(Builder& b, RandomTarget& target, double half_m, double front_m, const Material& metal,
                 const Material& foil) {
  const double ring_m = target.truth.ring_radius_m;
  const auto corner = [&](double size) {
    const double reach = half_m - size;
    return Vector3(b.sign() * b.between(0.75, 1.0) * reach, b.sign() * b.between(0.75, 1.0) * reach, front_m);
  };
  if (b.random.chance(0.7)) add_wings(b, half_m, front_m);
  if (b.random.chance(0.5)) {  // an antenna dish beside the body
    const double radius = b.between(0.4, 1.2) * ring_m, from = b.between(-0.9, 0.7) * radius;
    const double angle = b.between(0.0, 2.0 * std::numbers::pi), away = half_m * 1.45 + radius;
    b.add(Dish{radius, from}, metal,
          {away * std::cos(angle), away * std::sin(angle), front_m - b.between(0.0, 2.0) * radius});
  }
  if (b.random.chance(0.35)) {  // a second ring on the same face
    const double radius = std::min(0.35 * half_m, b.between(0.15, 0.4) * ring_m);
    add_ring(b, radius, b.between(0.05, 0.3), b.between(0.01, 0.1), corner(1.2 * radius) + Vector3(0, 0, 0.05), metal);
  }
  if (b.random.chance(0.3)) {  // a groove about the same axis, in the body's face
    const double radius = b.between(0.35, 0.85) * ring_m;
    b.add(FlatRing{radius * b.between(0.9, 0.97), radius}, metal, {0.0, 0.0, front_m + 0.002});
  }
  if (b.random.chance(0.6)) {  // square covers
    for (int k = 0; k < 3; ++k) {
      const double size = b.between(0.05, 0.25) * half_m;
      const Vector3 at = corner(size);
      b.add(SolidBox{{-size, -size, 0.0}, {size, size, b.between(0.02, 0.12)}}, b.random.chance(0.5) ? metal : foil,
            at);
    }
  }
  if (b.random.chance(0.7)) {  // thrusters
    for (int k = 0; k < 3; ++k) add_nozzle(b, b.between(0.03, 0.07), 0.1, b.between(0.05, 0.2), corner(0.1), metal);
  }
  if (b.random.chance(0.15)) {  // a boom over the face
    target.is_crossed = true;
    const double radius = b.between(0.01, 0.04), angle = b.between(0.0, 2.0 * std::numbers::pi);
    const double height = b.between(0.1, 0.4), aside = b.between(0.4, 0.95) * ring_m;
    Matrix3 R;  // its z along the face
    R.col(2) = Vector3(std::cos(angle), std::sin(angle), 0.0);
    R.col(0) = Vector3::UnitZ();
    R.col(1) = R.col(2).cross(R.col(0));
    const Vector3 across(-std::sin(angle), std::cos(angle), 0.0);
    b.add(ConeShell{radius, radius, 3.0 * half_m}, metal,
          aside * across - 1.5 * half_m * R.col(2) + Vector3(0, 0, height), R);
  }
}

RingAndNozzle random_truth(RandomStream& random, StereoRig& rig) {
  RingAndNozzle truth;
  truth.ring_radius_m = random.uniform(0.25, 0.65);
  truth.nozzle_radius_m = truth.ring_radius_m * random.uniform(0.2, 0.42);
  truth.distance_m = truth.ring_radius_m * random.uniform(0.35, 1.0);
  truth.normal = facing_normal(random.uniform(-20.0, 20.0) * kDegree, random.uniform(-16.0, 16.0) * kDegree);
  const double focal_px = random.uniform(550.0, 1200.0), toe_rad = random.uniform(8.0, 21.0) * kDegree;
  const double range_m = focal_px * truth.ring_radius_m / random.uniform(95.0, 210.0);
  rig = symmetric_rig(2.0 * range_m * std::tan(toe_rad), toe_rad, focal_px, 1280, 1024);
  if (random.chance(0.4)) {
    const double k1 = random.uniform(-0.12, 0.06);
    for (StereoCamera& camera : rig) camera.distortion = {k1, random.uniform(-0.02, 0.02), 1e-4, -1e-4, 0.0};
  }
  const double aside = 0.12 * range_m;
  truth.ring_centre_m = {random.uniform(-aside, aside), random.uniform(-aside, aside),
                         range_m * random.uniform(0.9, 1.1)};
  return truth;
}

void look(RandomTarget& target) {
  target.in_both_images = true;
  target.nozzle_minor_px = 1e9;
  for (const StereoCamera& camera : target.rig) {
    for (const SpaceCircle& circle : {target.truth.ring(), target.truth.nozzle()}) {
      const auto e = projected_ellipse(camera, circle);
      const double margin = 12.0;
      target.in_both_images = target.in_both_images && e && e->cx_px - e->a_px > margin &&
                              e->cy_px - e->a_px > margin && e->cx_px + e->a_px < camera.width_px - margin &&
                              e->cy_px + e->a_px < camera.height_px - margin;
      if (e) target.nozzle_minor_px = std::min(target.nozzle_minor_px, e->b_px);
    }
  }
  target.sun_incidence_rad = std::acos(std::clamp(target.truth.normal.dot(target.scene.to_sun), -1.0, 1.0));
}

}  // namespace

RandomTarget random_target(std::uint64_t seed) {
  RandomTarget target;
  Builder b{RandomStream(seed, "ring2 target"), {}, {}};
  target.truth = random_truth(b.random, target.rig);
  b.frame = frame_of(target.truth, b.between(0.0, 6.28));
  const double ring_m = target.truth.ring_radius_m, height_m = b.between(0.02, 0.2) * ring_m;
  const double half_m = b.between(1.15, 2.0) * ring_m;
  Material foil{b.between(0.15, 0.6), b.random.chance(0.5) ? b.between(0.1, 1.0) : 0.0, b.between(0.0, 0.5),
                b.between(0.03, 0.2)};
  const Material metal{b.between(0.35, 0.85), b.between(0.0, 0.3)};
  if (b.random.chance(0.2)) {  // a round body
    b.add(ConeShell{half_m, half_m, 2.0 * ring_m}, foil, {0.0, 0.0, -height_m - 2.0 * ring_m});
    b.add(FlatRing{0.0, half_m}, foil, {0.0, 0.0, -height_m});
  } else {
    const double other = half_m * b.between(0.8, 1.25);
    b.add(SolidBox{{-half_m, -other, -height_m - 2.0 * ring_m}, {half_m, other, -height_m}}, foil, Vector3::Zero());
  }
  add_ring(b, ring_m, b.between(0.04, 0.13), height_m, Vector3::Zero(), metal);
  const double lip = b.between(0.04, 0.15);
  const Material nozzle{b.between(0.2, 0.8), b.between(0.0, 0.3)};
  add_nozzle(b, target.truth.nozzle_radius_m, lip, target.truth.distance_m + height_m, {0.0, 0.0, -height_m}, nozzle);
  add_clutter(b, target, half_m, -height_m, metal, foil);
  if (b.random.chance(0.03)) {
    target.has_twin = true;
    const Vector3 aside((2.1 + b.between(0.0, 0.2)) * ring_m, 0.0, 0.0);
    add_ring(b, 0.95 * ring_m, 0.08, height_m, aside, metal);
    add_nozzle(b, target.truth.nozzle_radius_m, lip, target.truth.distance_m + height_m,
               aside - Vector3(0.0, 0.0, height_m), nozzle);
  }
  target.scene = std::move(b.scene);
  const double incidence = b.between(0.0, 75.0) * kDegree, turn = b.between(0.0, 6.28);
  target.scene.to_sun = b.frame.R * Vector3(std::sin(incidence) * std::cos(turn), std::sin(incidence) * std::sin(turn),
                                            std::cos(incidence));
  target.scene.fill = b.between(0.02, 0.15);
  target.blur_px = b.between(0.45, 1.1);
  target.electrons_per_light = b.between(5000.0, 16000.0);
  look(target);
  return target;
}

host::GreyImage image_of(const RandomTarget& target, std::size_t view, std::uint64_t seed) {
  const StereoCamera& camera = target.rig[view];
  const LinearImage light = solid_image(target.scene, camera, camera.R_rig_camera, camera.t_rig_camera_m);
  ImageSensor sensor;
  sensor.electrons_per_light = target.electrons_per_light;
  RandomStream random(seed, "ring2 pixels " + std::to_string(view));
  return expose(blurred(light, target.blur_px), sensor, random);
}

}  // namespace pharos::sim
