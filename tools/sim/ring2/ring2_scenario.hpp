// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/sim/ring2/stereo_rig.hpp"

namespace pharos::sim {

/// Where the ring is and how it is turned, one pair of images each.
struct Ring2Pose {
  Vector3 ring_centre_m = Vector3::Zero();
  double theta_deg = 0.0;
  double gamma_deg = 0.0;
};

/// What a scenario file says; the defaults are the file's. `poses` is the one thing without.
struct Ring2Scenario {
  StereoRig rig = symmetric_rig(1.8, 20.0 * 0.017453292519943295, 1000.0, 1280, 1024);
  RingAndNozzle target;          // sizes alone
  std::vector<Ring2Pose> poses;  // given ones, then random ones
  bool render = true;
  double edge_sigma_px = 0.0;  // of the analytic ellipses' edge points; 0: exact ellipses
  Vector3 sun_direction = Vector3(0.35, -0.5, -0.8).normalized();  // towards the sun, rig frame
  double fill_light = 0.06;                                        // of the sun's, from the cameras' side
  double blur_px = 0.7;
  int bits = 8;

  RingAndNozzle target_at(std::size_t pair) const;
};

/// Reads a scenario (`-`: standard input) strictly; random poses come from `seed`. Throws InputError naming file, line
/// and key.
Ring2Scenario read_ring2_scenario(const std::string& path, std::uint64_t seed);
/// The same from text.
Ring2Scenario parse_ring2_scenario(const std::string& text, const std::string& name, std::uint64_t seed);

/// POV-Ray's scene of one pair as one camera sees it: ring, nozzle and foiled body in hard light.
std::string ring2_scene_text(const Ring2Scenario& scenario, std::size_t pair, std::size_t view);

}  // namespace pharos::sim
