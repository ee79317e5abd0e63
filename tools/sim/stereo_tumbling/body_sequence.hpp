// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/sim/stereo_tumbling/random_body.hpp"

namespace pharos::sim {

/// A satellite drawn at random that turns about an axis of its own before two still cameras.
struct BodyScenario {
  double turn_deg = 360.0;
  double step_deg = 1.0;  ///< a pair
  double rate_hz = 10.0;
  std::int32_t width_px = 640;
  std::int32_t height_px = 480;
};

/// Rendered by own rays, with the shadows that the parts cast on each other. Some 0.2 s an image of 640 x 480.
class BodySequence {
 public:
  BodySequence(const BodyScenario& scenario, std::uint64_t seed);

  int frames() const;
  const RandomBody& body() const { return body_; }
  const host::RigFile& rig() const { return rig_; }
  /// T_rig_target of a frame.
  Pose<frame::Rig, frame::Target> pose(int frame) const;
  /// The pose of the target in the left camera's frame relative to that at frame 0, as `pharos slam` gives it.
  Pose<frame::Camera, frame::Target> truth(int frame) const;
  /// 8 bits; side 0 is left.
  host::GreyImage image(int frame, int side) const;

 private:
  LinearImage light(int frame, int side) const;

  BodyScenario scenario_;
  std::uint64_t seed_;
  RandomBody body_;
  host::RigFile rig_;
  Vector3 place_m_ = Vector3::Zero();  // of the body in the rig's frame
  double electrons_per_light_ = 8000.0;
};

/// DIR/left and right/NNNNNN.png, rig.toml and truth.tum. `step` is called after every pair.
void write_body(const BodyScenario& scenario, std::uint64_t seed, const std::string& directory,
                const std::function<void()>& step);

}  // namespace pharos::sim
