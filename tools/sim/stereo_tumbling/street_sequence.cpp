// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/street_sequence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/stereo_tumbling/cast_panels.hpp"
#include "tools/sim/stereo_tumbling/sequence_files.hpp"
#include "tools/sim/stereo_tumbling/textures.hpp"

namespace pharos::sim {
namespace {

constexpr int kStreetRaysPerSide = 2;
constexpr double kStreetBlur_px = 0.5;
constexpr double kStreetGain_e = 9000.0;
constexpr double kStreetBaseline_m = 0.54;
constexpr double kRadian = std::numbers::pi / 180.0;
constexpr double kCameraHeight_m = 1.65;
constexpr double kBeyond_m = 60.0;  // the street goes on
// A wall's picture of 8 mm a cell, painted this many times larger: stains of 3.5 m, windows and doors.
constexpr double kPaint = 5.0;
constexpr double kFarPaint = 30.0;
constexpr double kSky_m = 400.0, kSkyPaint = 120.0;
const Lighting kDaylight{0.55, 0.4, Vector3(200.0, -300.0, -100.0)};

void add_painted_panel(PanelScene& scene, const Vector3& corner, const Vector3& s, const Vector3& t, double paint,
                       RandomStream& random) {
  scene.panels.push_back({corner, s, t, static_cast<int>(scene.textures.size())});
  scene.textures.push_back(wall_texture(s.norm() / paint, t.norm() / paint, random));
}

host::RigFile street_rig(const StreetScenario& scenario) {
  const double size = scenario.width_px / 1226.0;
  host::RigFile rig;
  rig.left.intrinsics = rig.right.intrinsics =
      PinholeCamera{scenario.width_px, scenario.height_px, size * 707.0, size * 707.0, size * 602.0, size * 183.0, {}};
  rig.left.rotation_wxyz = rig.right.rotation_wxyz = {1.0, 0.0, 0.0, 0.0};
  rig.left.position_m = {0.0, 0.0, 0.0};
  rig.right.position_m = {kStreetBaseline_m, 0.0, 0.0};
  return rig;
}

}  // namespace

StreetSequence::StreetSequence(const StreetScenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      rig_(street_rig(scenario)),
      lens_(lens_of(rig_.left.intrinsics)),
      rays_(RayGrid::inside_pixels(lens_, kStreetRaysPerSide)) {
  RandomStream random(seed, "street");
  add_surroundings(random);
  add_roadside(random);
}

double StreetSequence::length_m() const {
  return 2.0 * scenario_.straight_m + scenario_.radius_m * scenario_.turn_deg * kRadian;
}

int StreetSequence::frames() const { return static_cast<int>(std::lround(length_m() / scenario_.step_m)) + 1; }

Pose<frame::Rig, frame::Rig> StreetSequence::road(double distance_m) const {
  const double radius = scenario_.radius_m, whole = scenario_.turn_deg * kRadian;
  const double turned = std::clamp((distance_m - scenario_.straight_m) / radius, 0.0, whole);
  const double first = std::min(distance_m, scenario_.straight_m);
  const double after = std::max(0.0, distance_m - scenario_.straight_m - radius * whole);
  // To the left: towards -x, about -y (down is +y).
  const Matrix3 R = rotation_exp(Vector3(0.0, -turned, 0.0));
  const Vector3 place(-radius * (1.0 - std::cos(turned)), 0.0, first + radius * std::sin(turned));
  return {R, place + after * (R * Vector3::UnitZ())};
}

bool StreetSequence::blocks_road(const Vector3& place, double half_m) const {
  for (double at = -kBeyond_m; at < length_m() + kBeyond_m; at += 1.0) {
    if ((road(at).t - place).head<3>().cwiseProduct(Vector3(1.0, 0.0, 1.0)).norm() < half_m + 2.0) return true;
  }
  return false;
}

void StreetSequence::add_turned_box(const Pose<frame::Rig, frame::Rig>& place, const Vector3& half, double paint,
                                    RandomStream& random) {
  PanelScene box;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    box.textures.push_back(
        wall_texture(2.0 * half[(axis + 1) % 3] / paint, 2.0 * half[(axis + 2) % 3] / paint, random));
  }
  add_box(box, Vector3::Zero(), half, static_cast<int>(street_.textures.size()));
  for (Texture& texture : box.textures) street_.textures.push_back(std::move(texture));
  for (const Panel& panel : moved(box, place.R, place.t).panels) street_.panels.push_back(panel);
}

// Houses, cars and posts on both sides.
void StreetSequence::add_roadside(RandomStream& random) {
  const auto put = [&](double distance_m, double aside_m, const Vector3& half) {
    Pose<frame::Rig, frame::Rig> place = road(distance_m);
    place.t = place * Vector3(aside_m, kCameraHeight_m - half.y(), 0.0);
    if (!blocks_road(place.t, std::min(half.x(), half.z()))) add_turned_box(place, half, kPaint, random);
  };
  for (const double side : {-1.0, 1.0}) {
    for (double at = -5.0; at < length_m() + kBeyond_m; at += 13.0) {
      const double depth = random.uniform(3.0, 5.0), away = random.uniform(7.0, 13.0);
      put(at, side * (away + depth), {depth, random.uniform(2.5, 6.0), random.uniform(3.5, 5.5)});
    }
    for (double at = 6.0; at < length_m() + kBeyond_m; at += random.uniform(8.0, 20.0)) {
      put(at, side * random.uniform(3.6, 4.5), {0.9, 0.75, 2.1});
    }
    for (double at = 3.0; at < length_m() + kBeyond_m; at += random.uniform(10.0, 18.0)) {
      put(at, side * random.uniform(3.2, 5.5), {0.08, 3.0, 0.08});
    }
  }
}

// Sky, a skyline and the ground along the road.
void StreetSequence::add_surroundings(RandomStream& random) {
  for (int k = 0; k < 4; ++k) {
    const Matrix3 R = rotation_exp(Vector3(0.0, 0.5 * std::numbers::pi * k, 0.0));
    add_painted_panel(street_, R * Vector3(-kSky_m, -kSky_m, kSky_m), R * Vector3(2.0 * kSky_m, 0.0, 0.0),
                      R * Vector3(0.0, kSky_m + 30.0, 0.0), kSkyPaint, random);
  }
  for (int k = 0; k < 24; ++k) {
    const double direction = 2.0 * std::numbers::pi * k / 24.0, away = random.uniform(120.0, 250.0);
    const Vector3 half(random.uniform(8.0, 20.0), random.uniform(5.0, 15.0), 8.0);
    const Matrix3 R = rotation_exp(Vector3(0.0, direction, 0.0));
    add_turned_box({R, R * Vector3(0.0, kCameraHeight_m - half.y(), away)}, half, kFarPaint, random);
  }
  constexpr double kTile_m = 12.0, kHalfWidth_m = 16.0;
  for (double at = -kTile_m; at < length_m() + 2.0 * kBeyond_m; at += kTile_m) {
    const Pose<frame::Rig, frame::Rig> place = road(at);
    // Tiles of a corner overlap; each lies a little deeper than the one before.
    const double depth_m = kCameraHeight_m + 1e-4 * at;
    add_painted_panel(street_, place * Vector3(-kHalfWidth_m, depth_m, 0.0),
                      place.R * Vector3(2.0 * kHalfWidth_m, 0.0, 0.0), place.R * Vector3(0.0, 0.0, kTile_m), kPaint,
                      random);
  }
}

Pose<frame::Rig, frame::Camera> StreetSequence::pose(int frame, int side) const {
  const double driven_m = frame * scenario_.step_m;
  Pose<frame::Rig, frame::Rig> car = road(driven_m);
  car.t.y() += 0.02 * std::sin(0.9 * driven_m);
  car.R = car.R * rotation_exp(Vector3(0.006 * std::sin(0.7 * driven_m), 0.0, 0.004 * std::sin(0.4 * driven_m)));
  if (side == 0) return car * rig_.left.pose();
  Pose<frame::Rig, frame::Camera> right = rig_.right.pose();
  right.R = rotation_exp(Vector3(0.0, scenario_.rig_yaw_deg * kRadian, 0.0)) * right.R;
  return car * right;
}

Pose<frame::Camera, frame::Camera> StreetSequence::truth(int frame) const {
  return pose(0, 0).inverse() * pose(frame, 0);
}

host::GreyImage StreetSequence::image(int frame, int side) const {
  RandomStream random(seed_, (side == 0 ? "left " : "right ") + std::to_string(frame));
  ImageSensor sensor;
  sensor.electrons_per_light = kStreetGain_e;
  const LinearImage light = cast_panels(street_, kDaylight, lens_, rays_, kStreetRaysPerSide, pose(frame, side));
  return expose(blurred(light, kStreetBlur_px), sensor, random);
}

void write_street(const StreetScenario& scenario, std::uint64_t seed, const std::string& directory,
                  const std::function<void()>& step) {
  const StreetSequence sequence(scenario, seed);
  SequenceFiles files(directory, sequence.rig());
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    std::array<char, 16> stem{};
    std::snprintf(stem.data(), stem.size(), "%06d", frame);
    for (int side = 0; side < 2; ++side) files.image(stem.data(), side, sequence.image(frame, side));
    const auto pose = sequence.truth(frame);
    files.truth(frame / scenario.rate_hz, pose.t, pose.quaternion());
    step();
  }
  files.finish();
}

}  // namespace pharos::sim
