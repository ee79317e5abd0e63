// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/povray/render_scene.hpp"
#include "tools/sim/povray/scene_text.hpp"
#include "tools/sim/povray/temporary_folder.hpp"
#include "tools/sim/stereo_tumbling/cast_panels.hpp"
#include "tools/sim/stereo_tumbling/povray_panels.hpp"
#include "tools/sim/stereo_tumbling/satellite_scene.hpp"
#include "tools/sim/stereo_tumbling/sequence_files.hpp"

namespace pharos::sim {
namespace {

constexpr int kRaysPerSide = 2;
constexpr double kAntialias = 0.02;
constexpr double kBlur_px = 0.6;  // of the optics
constexpr double kGloss = 0.15;
constexpr double kPeak_e = 8000.0;
const Vector3 kLamp_m(0.5, -1.0, -1.0);

// The satellite's z axis, about which it turns, leans towards the cameras and aside: four of its faces pass by and one
// stays in view.
Matrix3 start_attitude() {
  return rotation_exp(Vector3(0.35, 0.0, 0.0)) * rotation_exp(Vector3(0.0, 0.0, 0.2)) *
         rotation_exp(Vector3(0.5 * std::numbers::pi, 0.0, 0.0));
}

Lighting lighting_of(const TumblingScenario& scenario) {
  return {scenario.ambient, scenario.good_light ? 0.9 : 0.0, kLamp_m};
}

}  // namespace

struct TumblingSequence::Work {
  PanelScene satellite;
  std::vector<Star> stars;
  std::array<Lens, 2> lenses;
  std::array<Pose<frame::Rig, frame::Camera>, 2> T_rig_camera;
  std::optional<RayGrid> rays;
  TemporaryFolder textures{"pharos-textures"};
  ImageSensor sensor;
  int rendered_frame = -1, rendered_side = -1;
  LinearImage rendered;

  LinearImage render(const PanelScene& scene, const Lighting& lighting, std::size_t side, bool povray) const {
    const Lens& lens = lenses[side];
    if (!povray) return cast_panels(scene, lighting, lens, *rays, kRaysPerSide, T_rig_camera[side]);
    return render_scene(povray_preamble() + povray_camera(lens, T_rig_camera[side].R, T_rig_camera[side].t) +
                            povray_panels(scene, lighting, textures.path(), kGloss),
                        {lens.width_px, lens.height_px, kRaysPerSide, kAntialias, 1});
  }

  // With stars, through the optics.
  LinearImage seen(const PanelScene& scene, const Lighting& lighting, std::size_t side, bool povray) const {
    LinearImage image = render(scene, lighting, side, povray);
    draw_stars(image, stars, lenses[side], T_rig_camera[side]);
    return blurred(image, kBlur_px);
  }
};

host::RigFile tumbling_rig(const TumblingScenario& scenario) {
  const double focal = scenario.focal_px * scenario.width_px / 640.0;
  host::RigFile rig;
  rig.left.intrinsics = optics_as<PinholeCamera>(centred_lens(scenario.width_px, scenario.height_px, focal));
  rig.right.intrinsics = rig.left.intrinsics;
  rig.left.position_m = {-0.5 * scenario.baseline_m, 0.0, 0.0};
  rig.right.position_m = {0.5 * scenario.baseline_m, 0.0, 0.0};
  return rig;
}

TumblingSequence::TumblingSequence(const TumblingScenario& scenario, std::uint64_t seed)
    : scenario_(scenario), seed_(seed), work_(std::make_unique<Work>()) {
  Work& work = *work_;
  work.satellite = satellite_scene(seed);
  work.stars = star_field(scenario.stars, seed);
  const host::RigFile rig = tumbling_rig(scenario);
  work.lenses = {lens_of(rig.left.intrinsics), lens_of(rig.right.intrinsics)};
  work.T_rig_camera = {rig.left.pose(), rig.right.pose()};
  if (scenario.povray) {
    write_texture_files(work.satellite, work.textures.path());
  } else {
    work.rays = RayGrid::inside_pixels(work.lenses[0], kRaysPerSide);
  }
  // The gain that lets good light peak at 80 % of the well, for low light too.
  const auto start = pose(0);
  const LinearImage good =
      work.render(moved(work.satellite, start.R, start.t), {0.1, 0.9, kLamp_m}, 0, scenario.povray);
  work.sensor.electrons_per_light = kPeak_e / peak_light(good);
}

TumblingSequence::~TumblingSequence() = default;

int TumblingSequence::frames() const {
  return static_cast<int>(std::lround(scenario_.turn_deg / scenario_.step_deg)) + 1;
}

host::RigFile TumblingSequence::rig() const { return tumbling_rig(scenario_); }

Pose<frame::Rig, frame::Target> TumblingSequence::pose(int frame) const {
  const double turned = frame * scenario_.step_deg * std::numbers::pi / 180.0;
  return {start_attitude() * rotation_exp(Vector3(0.0, 0.0, turned)), Vector3(0.0, 0.0, scenario_.distance_m)};
}

Pose<frame::Camera, frame::Target> TumblingSequence::truth(int frame) const {
  const auto T_left_rig = work_->T_rig_camera[0].inverse();
  const auto now = T_left_rig * pose(frame), first = T_left_rig * pose(0);
  // The target's frame is the left camera's own at frame 0: T_now = [now] [first]^-1.
  return {now.R * first.R.transpose(), now.t - now.R * first.R.transpose() * first.t};
}

host::GreyImage TumblingSequence::image(int frame, int side) {
  Work& work = *work_;
  const auto k = static_cast<std::size_t>(side);
  if (work.rendered_frame != frame || work.rendered_side != side) {
    const auto here = pose(frame);
    const Lighting light = lighting_of(scenario_);
    work.rendered = work.seen(moved(work.satellite, here.R, here.t), light, k, scenario_.povray);
    work.rendered_frame = frame;
    work.rendered_side = side;
  }
  RandomStream random(seed_, (side == 0 ? "left " : "right ") + std::to_string(frame));
  return expose(work.rendered, work.sensor, random);
}

std::array<host::GreyImage, 3> TumblingSequence::colour_image(int frame, int side) {
  if (scenario_.povray) throw std::logic_error("colours are seen by rays of our own only");
  const Work& work = *work_;
  const auto here = pose(frame);
  std::array<host::GreyImage, 3> planes;
  for (int channel = 0; channel < 3; ++channel) {
    const PanelScene scene = moved(through_filter(work.satellite, channel), here.R, here.t);
    RandomStream random(seed_,
                        (side == 0 ? "left " : "right ") + std::to_string(frame) + " of " + std::to_string(channel));
    planes[static_cast<std::size_t>(channel)] =
        expose(work.seen(scene, lighting_of(scenario_), static_cast<std::size_t>(side), false), work.sensor, random);
  }
  return planes;
}

void write_tumbling(const TumblingScenario& scenario, std::uint64_t seed, const std::string& directory,
                    const std::function<void()>& step) {
  TumblingSequence sequence(scenario, seed);
  SequenceFiles files(directory, sequence.rig());
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    for (int side = 0; side < 2; ++side)
      files.image(padded_number(static_cast<std::size_t>(frame), 6), side, sequence.image(frame, side));
    const auto pose = sequence.truth(frame);
    files.truth(frame / scenario.rate_hz, pose.t, pose.quaternion());
    step();
  }
  files.finish();
}

}  // namespace pharos::sim
