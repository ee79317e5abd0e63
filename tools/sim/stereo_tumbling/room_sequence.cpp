// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/room_sequence.hpp"

#include <cmath>
#include <numbers>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/stereo_tumbling/cast_panels.hpp"
#include "tools/sim/stereo_tumbling/sequence_files.hpp"
#include "tools/sim/stereo_tumbling/textures.hpp"

namespace pharos::sim {
namespace {

constexpr int kRoomRaysPerSide = 2;
constexpr double kRoomBlur_px = 0.6;
constexpr double kGain_e = 9000.0;  // of a white wall facing the lamp: below the well
const Lighting kLighting{0.35, 0.5, Vector3(0.0, -1.0, 0.0)};
constexpr double kLap_rad = 2.0 * std::numbers::pi;
// Half axes of the ellipse that is walked, and of the room, m.
constexpr double kWalkX_m = 2.2, kWalkZ_m = 1.5;
const Vector3 kRoomHalf_m(4.0, 1.5, 3.2);
constexpr std::int64_t kFirstStamp_ns = 1'400'000'000'000'000'000;

void add_textured_box(PanelScene& scene, const Vector3& centre, const Vector3& half, RandomStream& random) {
  const auto first = static_cast<int>(scene.textures.size());
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    scene.textures.push_back(wall_texture(2.0 * half[(axis + 1) % 3], 2.0 * half[(axis + 2) % 3], random));
  }
  add_box(scene, centre, half, first);
}

host::RigFile raw_rig(const RoomScenario& scenario) {
  const double size = scenario.width_px / 752.0;
  const auto camera = [&](double fx, double fy, double cx, double cy) {
    return PinholeCamera{scenario.width_px, scenario.height_px, size * fx, size * fy, size * cx, size * cy, {}};
  };
  host::RigFile rig;
  rig.left.intrinsics = camera(458.7, 457.3, 367.2, 248.4);
  rig.right.intrinsics = camera(457.6, 456.1, 379.9, 255.2);
  rig.left.intrinsics.distortion = {-0.2834, 0.0740, 0.0002, 0.00002, 0.0};
  rig.right.intrinsics.distortion = {-0.2837, 0.0745, -0.0001, -0.00004, 0.0};
  const Quaternion left(rotation_exp(Vector3(0.010, -0.006, 0.014)));
  const Quaternion right(rotation_exp(Vector3(-0.004, 0.009, 0.002)));
  rig.left.rotation_wxyz = {left.w(), left.x(), left.y(), left.z()};
  rig.right.rotation_wxyz = {right.w(), right.x(), right.y(), right.z()};
  rig.left.position_m = {-0.055, 0.001, 0.002};
  rig.right.position_m = {0.055, -0.001, -0.001};
  return rig;
}

}  // namespace

RoomSequence::RoomSequence(const RoomScenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      rig_(raw_rig(scenario)),
      lenses_{lens_of(rig_.left.intrinsics), lens_of(rig_.right.intrinsics)},
      rays_{RayGrid::inside_pixels(lenses_[0], kRoomRaysPerSide),
            RayGrid::inside_pixels(lenses_[1], kRoomRaysPerSide)} {
  RandomStream random(seed, "room");
  add_textured_box(room_, Vector3::Zero(), kRoomHalf_m, random);
  for (const Vector3& place : {Vector3(3.2, 0.9, 2.4), Vector3(-3.3, 0.7, 2.2), Vector3(3.3, 1.0, -2.4),
                               Vector3(-3.2, 0.9, -2.3), Vector3(0.0, 1.1, 0.0)}) {
    add_textured_box(room_, place, {0.4, kRoomHalf_m.y() - place.y(), 0.4}, random);
  }
}

int RoomSequence::frames() const {
  return static_cast<int>(std::lround(scenario_.path_m / scenario_.speed_m_s * scenario_.rate_hz)) + 1;
}

Pose<frame::Rig, frame::Camera> RoomSequence::pose(int frame, int side) const {
  // About equal steps along the ellipse, a hand's sway on top.
  const double walked_m = frame * scenario_.speed_m_s / scenario_.rate_hz;
  const double perimeter_m = kLap_rad * std::sqrt(0.5 * (kWalkX_m * kWalkX_m + kWalkZ_m * kWalkZ_m));
  const double lap = kLap_rad * walked_m / perimeter_m;
  const Vector3 position(kWalkX_m * std::cos(lap), 0.10 * std::sin(5.3 * lap) - 0.1, kWalkZ_m * std::sin(lap));
  const double ahead = std::atan2(-kWalkX_m * std::sin(lap), kWalkZ_m * std::cos(lap));
  const Matrix3 R = rotation_exp(Vector3(0.0, ahead + 0.25 * std::sin(2.3 * lap), 0.0)) *
                    rotation_exp(Vector3(0.06 * std::sin(7.1 * lap), 0.0, 0.05 * std::sin(4.7 * lap)));
  // The room's frame has the axes of a rig's; T_room_camera = T_room_rig T_rig_camera.
  const Pose<frame::Rig, frame::Rig> T_room_rig{R, position};
  return T_room_rig * (side == 0 ? rig_.left : rig_.right).pose();
}

Pose<frame::Camera, frame::Camera> RoomSequence::truth(int frame) const {
  return pose(0, 0).inverse() * pose(frame, 0);
}

host::GreyImage RoomSequence::image(int frame, int side) const {
  const auto k = static_cast<std::size_t>(side);
  RandomStream random(seed_, (side == 0 ? "left " : "right ") + std::to_string(frame));
  ImageSensor sensor;
  sensor.electrons_per_light = kGain_e;
  const LinearImage light = cast_panels(room_, kLighting, lenses_[k], rays_[k], kRoomRaysPerSide, pose(frame, side));
  return expose(blurred(light, kRoomBlur_px), sensor, random);
}

void write_room(const RoomScenario& scenario, std::uint64_t seed, const std::string& directory,
                const std::function<void()>& step) {
  const RoomSequence sequence(scenario, seed);
  SequenceFiles files(directory, sequence.rig());
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    const std::int64_t stamp_ns = kFirstStamp_ns + std::llround(frame / scenario.rate_hz * 1e9);
    for (int side = 0; side < 2; ++side) files.image(std::to_string(stamp_ns), side, sequence.image(frame, side));
    const auto pose = sequence.truth(frame);
    files.truth(static_cast<double>(stamp_ns) * 1e-9, pose.t, pose.quaternion());
    step();
  }
  files.finish();
}

}  // namespace pharos::sim
