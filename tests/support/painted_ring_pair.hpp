// SPDX-License-Identifier: Apache-2.0
#pragma once

// Images of ring and nozzle in a rig of two cameras, painted with exact edges: pairs with known truth, in a fraction of
// a second and without POV-Ray.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/evaluation/problems/painted_scene.hpp"
#include "tools/sim/ring2/stereo_rig.hpp"

namespace pharos::test {

struct PaintedRig {
  /// Half the size and the resolution of paper 001's.
  sim::StereoRig rig = sim::symmetric_rig(1.8, 0.35, 500.0, 640, 512);

  host::RigFile file() const {
    host::RigFile out;
    for (std::size_t side = 0; side < 2; ++side) {
      const sim::StereoCamera& camera = rig[side];
      host::RigCamera& target = side == 0 ? out.left : out.right;
      target.intrinsics = sim::optics_as<PinholeCamera>(camera);
      const Quaternion q = canonical_quaternion(camera.R_rig_camera);
      target.rotation_wxyz = {q.w(), q.x(), q.y(), q.z()};
      const Vector3& t = camera.t_rig_camera_m;
      target.position_m = {t.x(), t.y(), t.z()};
    }
    return out;
  }

  host::GreyImage image(const sim::RingAndNozzle& target, std::size_t side, std::uint64_t seed) const {
    const sim::StereoCamera& camera = rig[side];
    PaintedScene scene({camera.width_px, camera.height_px, camera.fx_px}, 0.12);
    const auto add = [&](const sim::SpaceCircle& circle, double fraction, double value) {
      const Vector3 centre = camera.R_rig_camera.transpose() * (circle.centre_m - camera.t_rig_camera_m);
      const Vector3 normal = camera.R_rig_camera.transpose() * circle.normal;
      scene.add(
          {Disc{{centre.x(), centre.y(), centre.z()}, {normal.x(), normal.y(), normal.z()}, fraction * circle.radius_m},
           value});
    };
    add(target.ring(), 1.0, 0.8);
    add(target.ring(), 0.88, 0.25);
    add(target.nozzle(), 1.0, 0.6);
    std::mt19937_64 random(seed);
    return {camera.width_px, camera.height_px, 16, scene.image({}, random)};
  }
};

/// A ring of paper 001 some 2.6 m away, turned by theta about x and gamma about y.
inline sim::RingAndNozzle ring_at(const Vector3& centre_m, double theta_rad, double gamma_rad) {
  sim::RingAndNozzle target;
  target.ring_centre_m = centre_m;
  target.normal = sim::facing_normal(theta_rad, gamma_rad);
  return target;
}

}  // namespace pharos::test
