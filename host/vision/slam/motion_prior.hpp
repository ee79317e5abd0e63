// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// Where the target was when it was placed last, and how fast it moved.
struct MotionPrior {
  CameraFromTarget last;
  Vector3 centre_m = Vector3::Zero();  ///< of the points observed then, in the target's frame
  double rate_rad_s = 0.0;
  double speed_m_s = 0.0;  ///< of the centre, in the camera's frame
};

/// Whether the target can have come to `found` after `elapsed_s`.
///
/// It moves at most twice as fast as when it was seen last (a free body's rate changes by the ratio of its moments of
/// inertia; a camera that moves may accelerate), and 30 deg beyond that: descriptors are known again over half of the
/// 60 deg from which a point looks different, so that a nearer place is observed through the same points, and a body's
/// alike parts are 60 deg or more apart. The centre's direction and distance are held to the same.
bool can_have_come_to(const MotionPrior& prior, const CameraFromTarget& found, double elapsed_s);

}  // namespace pharos::slam
