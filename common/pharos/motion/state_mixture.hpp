// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/motion/kinematic_state.hpp"

namespace pharos::motion {

/// Moments of a mixture of two estimates, the second with the fraction `weight`. `linked`: with the pose of a second
/// station.
void blend(RestingState& into, const MovingState& other, double weight, bool linked);
void blend(MovingState& into, const MovingState& other, double weight, bool linked);

}  // namespace pharos::motion
