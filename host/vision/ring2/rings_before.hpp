// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/ring2/ring_hypothesis.hpp"

namespace pharos::host {

/// Rings in front of a ring with a nozzle, on its axis, each from an ellipse that one image alone may have: where
/// booms and shadows cross the docking ring neither image need have the same edge of it, and no pair of ellipses is a
/// start value. The circle about a known axis follows from one ellipse.
///
/// `contours`: the ellipses of both images. The nozzle stays where it is.
std::vector<RingHypothesis> rings_before(const ring2::Rig& rig,
                                         const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours,
                                         const ring2::CircleModel& found);

}  // namespace pharos::host
