// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// Paper 004, section 3: a satellite that turns about one axis before two still cameras.
struct TumblingScenario {
  double turn_deg = 360.0;
  double step_deg = 0.5;  ///< a frame
  /// Good light: a lamp behind the cameras and ambient 0.1. Low light: no lamp, `ambient` alone, the same gain.
  bool good_light = true;
  double ambient = 0.1;
  std::int32_t width_px = 640;
  std::int32_t height_px = 480;
  double focal_px = 640.0;  ///< of 640 columns; goes with the width
  double baseline_m = 0.5;
  double distance_m = 5.0;
  int stars = 60;
  double rate_hz = 20.0;
  bool povray = true;  ///< else rays of our own: no gloss, a third of the time
};

/// The two still cameras of a scenario.
host::RigFile tumbling_rig(const TumblingScenario& scenario);

/// Renders a sequence and keeps what every frame shares.
class TumblingSequence {
 public:
  TumblingSequence(const TumblingScenario& scenario, std::uint64_t seed);
  ~TumblingSequence();

  int frames() const;
  host::RigFile rig() const;
  /// T_rig_target of a frame.
  Pose<frame::Rig, frame::Target> pose(int frame) const;
  /// The pose of the target in the left camera's frame relative to that at frame 0, as `pharos slam` gives it.
  Pose<frame::Camera, frame::Target> truth(int frame) const;
  /// 8 bits; side 0 is left. The same frame again is exposed anew from the same light.
  host::GreyImage image(int frame, int side);
  /// Red, green and blue of the same moment: golden foil, blue cells, white stars; noise of each plane its own. By rays
  /// of our own only: throws std::logic_error for a scenario with POV-Ray.
  std::array<host::GreyImage, 3> colour_image(int frame, int side);

 private:
  struct Work;
  TumblingScenario scenario_;
  std::uint64_t seed_;
  std::unique_ptr<Work> work_;
};

/// DIR/left and right/NNNNNN.png, rig.toml and truth.tum. `step` is called after every pair.
void write_tumbling(const TumblingScenario& scenario, std::uint64_t seed, const std::string& directory,
                    const std::function<void()>& step);

}  // namespace pharos::sim
