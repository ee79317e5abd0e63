// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/sim/optics/ray_grid.hpp"
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// A walk through a furnished room with a raw stereo camera (EuRoC class): barrel distortion, cameras turned against
/// each other and against their baseline of 0.11 m.
struct RoomScenario {
  double path_m = 60.0;
  double speed_m_s = 0.9;
  double rate_hz = 20.0;
  std::int32_t width_px = 752;
  std::int32_t height_px = 480;
};

class RoomSequence {
 public:
  RoomSequence(const RoomScenario& scenario, std::uint64_t seed);

  int frames() const;
  host::RigFile rig() const { return rig_; }
  /// T_first_now of the left camera: what `pharos slam --scene static --output camera` gives.
  Pose<frame::Camera, frame::Camera> truth(int frame) const;
  /// 8 bits; side 0 is left.
  host::GreyImage image(int frame, int side) const;

 private:
  Pose<frame::Rig, frame::Camera> pose(int frame, int side) const;

  RoomScenario scenario_;
  std::uint64_t seed_;
  host::RigFile rig_;
  std::array<Lens, 2> lenses_;
  std::array<RayGrid, 2> rays_;
  PanelScene room_;
};

/// DIR/left and right/STAMP.png (ns), rig.toml and truth.tum (of the camera). `step` is called after every pair.
void write_room(const RoomScenario& scenario, std::uint64_t seed, const std::string& directory,
                const std::function<void()>& step);

}  // namespace pharos::sim
