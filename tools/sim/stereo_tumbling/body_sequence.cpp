// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/body_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/stereo_tumbling/sequence_files.hpp"

namespace pharos::sim {
namespace {

constexpr int kRays = 16;         // of a pixel where light changes
constexpr double kBlur_px = 0.6;  // of the optics
constexpr double kPeak_e = 8000.0;
constexpr int kExposureLooks = 6;  // over the turn, for one exposure that suits it

Pose<frame::Rig, frame::Camera> camera_pose(const host::RigFile& rig, int side) {
  return side == 0 ? rig.left.pose() : rig.right.pose();
}

}  // namespace

BodySequence::BodySequence(const BodyScenario& scenario, std::uint64_t seed)
    : scenario_(scenario), seed_(seed), body_(random_body(seed)) {
  RandomStream random(seed, "body's rig");
  const double focal_px = random.uniform(600.0, 900.0) * scenario.width_px / 640.0;
  rig_.left.intrinsics = optics_as<PinholeCamera>(centred_lens(scenario.width_px, scenario.height_px, focal_px));
  rig_.right.intrinsics = rig_.left.intrinsics;
  // The body fills 0.75 to 1.05 of the image's height at its widest.
  const double distance_m = 2.0 * focal_px * body_.reach_m / (random.uniform(0.75, 1.05) * scenario.height_px);
  const double baseline_m = distance_m * random.uniform(0.06, 0.11);
  rig_.left.position_m = {-0.5 * baseline_m, 0.0, 0.0};
  rig_.right.position_m = {0.5 * baseline_m, 0.0, 0.0};
  place_m_ = {0.02 * distance_m * random.normal(), 0.02 * distance_m * random.normal(), distance_m};
  double peak = 0.0;
  for (int k = 0; k < kExposureLooks; ++k) peak = std::max(peak, peak_light(light(k * frames() / kExposureLooks, 0)));
  electrons_per_light_ = kPeak_e / peak;
}

int BodySequence::frames() const { return static_cast<int>(std::lround(scenario_.turn_deg / scenario_.step_deg)) + 1; }

Pose<frame::Rig, frame::Target> BodySequence::pose(int frame) const {
  const double turned_rad = frame * scenario_.step_deg * std::numbers::pi / 180.0;
  return {body_.R_rig_body * rotation_exp(turned_rad * body_.spin_axis_body), place_m_};
}

Pose<frame::Camera, frame::Target> BodySequence::truth(int frame) const {
  const auto T_left_rig = camera_pose(rig_, 0).inverse();
  const auto now = T_left_rig * pose(frame), first = T_left_rig * pose(0);
  return {now.R * first.R.transpose(), now.t - now.R * first.R.transpose() * first.t};
}

LinearImage BodySequence::light(int frame, int side) const {
  const Pose<frame::Rig, frame::Target> now = pose(frame);
  SolidScene scene = body_.scene;
  scene.to_sun = now.R.transpose() * body_.to_sun_rig;
  scene.fill = body_.fill;
  const auto T_body_camera = now.inverse() * camera_pose(rig_, side);
  return solid_image(scene, lens_of(rig_.left.intrinsics), T_body_camera.R, T_body_camera.t, kRays);
}

host::GreyImage BodySequence::image(int frame, int side) const {
  ImageSensor sensor;
  sensor.electrons_per_light = electrons_per_light_;
  RandomStream random(seed_, (side == 0 ? "body left " : "body right ") + std::to_string(frame));
  return expose(blurred(light(frame, side), kBlur_px), sensor, random);
}

void write_body(const BodyScenario& scenario, std::uint64_t seed, const std::string& directory,
                const std::function<void()>& step) {
  const BodySequence sequence(scenario, seed);
  SequenceFiles files(directory, sequence.rig());
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    for (int side = 0; side < 2; ++side) {
      files.image(padded_number(static_cast<std::size_t>(frame), 6), side, sequence.image(frame, side));
    }
    const auto pose = sequence.truth(frame);
    files.truth(frame / scenario.rate_hz, pose.t, pose.quaternion());
    step();
  }
  files.finish();
}

}  // namespace pharos::sim
