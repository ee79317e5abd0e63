// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"

namespace pharos::tools {

/// T_true_assumed: the rigid motion from the assumed sensor positions to the true ones, by least squares.
Pose<frame::Body, frame::Body> body_frame_of(const Target& assumed, const Target& built);

}  // namespace pharos::tools
