// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "pharos/base/units.hpp"
#include "tools/sim/approach/raw/approach_body.hpp"
#include "tools/sim/approach/raw/raw_source.hpp"
#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/ring2/ring2_writer.hpp"
#include "tools/sim/stereo_tumbling/sequence_files.hpp"

namespace pharos::sim {
namespace {

constexpr int kRays = 16;         // of a pixel where light changes
constexpr double kBlur_px = 0.6;  // of the optics
constexpr double kFill = 0.06;    // of the sun's light, from the cameras' side
// A facing surface of albedo 0.6 in full sun fills 80 % of the well.
constexpr double kElectronsPerLight = 8000.0 / 0.6;

// Both images of every frame, handed to `write(name, side, image)`.
template <class Write>
void render(const RawOutput& output, const StereoRig& rig, Write write) {
  const ApproachScenario& scenario = output.simulator.scenario();
  SolidScene scene = sunlit_scene(approach_satellite(lighthouse_target(scenario)));
  scene.fill = kFill;
  ImageSensor sensor;
  sensor.electrons_per_light = kElectronsPerLight;
  for (const RawFrame& frame : raw_frames(output.simulator, output.source, docking_ring(scenario))) {
    scene.to_sun = frame.to_sun_ring;
    const auto T_ring_rig = frame.T_sensor_ring.inverse();
    for (std::size_t side = 0; side < 2; ++side) {
      const StereoCamera& camera = rig[side];
      const LinearImage light =
          solid_image(scene, camera, T_ring_rig.R * camera.R_rig_camera, T_ring_rig * camera.t_rig_camera_m, kRays);
      RandomStream random(output.seed,
                          std::to_string(output.source) + " pixels " + frame.name + (side == 0 ? "l" : "r"));
      write(frame.name, static_cast<int>(side), expose(blurred(light, kBlur_px), sensor, random));
    }
    output.written();
  }
}

// Far off the body is small: a long focal length, and a baseline that a vehicle has.
StereoRig slam_rig() {
  StereoRig rig;
  for (StereoCamera& camera : rig) static_cast<Lens&>(camera) = centred_lens(640, 480, 1000.0);
  rig[1].t_rig_camera_m = {0.9, 0.0, 0.0};
  return rig;
}

// Axes meet at 2.6 m; the ring of 1.1 m is within both images from there to 5 m.
StereoRig ring2_rig() { return symmetric_rig(1.4, 15.0 * kRadPerDeg, 640.0, 1024, 800); }

}  // namespace

void write_raw_ring2(const RawOutput& output) {
  make_output_folder(output.folder);
  const StereoRig rig = ring2_rig();
  write_output(output.folder / "rig.toml", rig_text_of(rig));
  render(output, rig, [&](const std::string& name, int side, const host::GreyImage& image) {
    const std::string file = name + (side == 0 ? "_left.png" : "_right.png");
    host::write_grey_png((output.folder / file).string(), image.view(), 8);
  });
}

void write_raw_slam(const RawOutput& output) {
  const StereoRig rig = slam_rig();
  host::RigFile file;
  file.left.intrinsics = optics_as<PinholeCamera>(rig[0]);
  file.right.intrinsics = optics_as<PinholeCamera>(rig[1]);
  file.right.position_m = {rig[1].t_rig_camera_m.x(), 0.0, 0.0};
  const SequenceFiles files(output.folder.string(), file);
  render(output, rig,
         [&](const std::string& name, int side, const host::GreyImage& image) { files.image(name, side, image); });
}

}  // namespace pharos::sim
