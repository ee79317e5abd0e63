// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/sim/optics/ray_grid.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// A drive along a street and round a corner with a rectified stereo camera on a car (KITTI class: 10 Hz, 1.2 m from
/// pair to pair, baseline 0.54 m): houses, cars and posts beside it, a bright sky above.
struct StreetScenario {
  double straight_m = 36.0;  ///< before the corner, and as much after it
  double turn_deg = 90.0;    ///< to the left; a corner of `radius_m`
  double radius_m = 12.0;
  double step_m = 1.2;  ///< from pair to pair
  double rate_hz = 10.0;
  std::int32_t width_px = 1226;
  std::int32_t height_px = 370;
  /// Error of the rig file: the right camera is turned by this about the vertical axis, which displaces its image.
  double rig_yaw_deg = 0.0;
};

class StreetSequence {
 public:
  StreetSequence(const StreetScenario& scenario, std::uint64_t seed);

  int frames() const;
  host::RigFile rig() const { return rig_; }
  /// T_first_now of the left camera: what `pharos slam --output camera` gives.
  Pose<frame::Camera, frame::Camera> truth(int frame) const;
  /// 8 bits; side 0 is left.
  host::GreyImage image(int frame, int side) const;

 private:
  /// Position on the road and heading after `distance_m`.
  Pose<frame::Rig, frame::Rig> road(double distance_m) const;
  double length_m() const;
  bool blocks_road(const Vector3& place, double half_m) const;
  void add_turned_box(const Pose<frame::Rig, frame::Rig>& place, const Vector3& half, double paint,
                      RandomStream& random);
  void add_roadside(RandomStream& random);
  void add_surroundings(RandomStream& random);
  Pose<frame::Rig, frame::Camera> pose(int frame, int side) const;

  StreetScenario scenario_;
  std::uint64_t seed_;
  host::RigFile rig_;
  Lens lens_;
  RayGrid rays_;
  PanelScene street_;
};

/// DIR/left and right/NNNNNN.png, rig.toml and truth.tum (of the camera). `step` is called after every pair.
void write_street(const StreetScenario& scenario, std::uint64_t seed, const std::string& directory,
                  const std::function<void()>& step);

}  // namespace pharos::sim
