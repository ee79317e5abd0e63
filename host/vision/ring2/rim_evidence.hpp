// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/ring2/ring_hypothesis.hpp"

namespace pharos::host {

/// Log of the likelihood ratio that a circle has a second one in its plane about its centre, both images together: the
/// other edge of a rim, up to a fifth of the radius wider or narrower. A docking ring has it; the edge of a round body,
/// the foot of a wall and a shadow have not.
double rim_evidence(const ring2::Rig& rig, const Ring2Images& images, const ExpectedCircle& circle);

}  // namespace pharos::host
