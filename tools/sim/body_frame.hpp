// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"

namespace pharos::sim {

/// T_true_assumed: the rigid motion from the assumed sensor positions to the true ones, by least squares. The body
/// frame is defined by the positions of the sensors: where these have errors, this is how far the two frames differ.
Pose<frame::Body, frame::Body> body_frame_of(const Target& assumed, const Target& built);

}  // namespace pharos::sim
