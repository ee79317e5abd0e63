// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/ring2/ring_hypothesis.hpp"

namespace pharos::host {

/// Log-likelihood ratio, over both images, for a second concentric circle in the plane of a circle: the other edge of a
/// rim, up to a fifth of the radius wider or narrower. A docking ring has one; the edge of a round body, the foot of a
/// wall and a shadow do not.
double rim_evidence(const ring2::Rig& rig, const Ring2Images& images, const ExpectedCircle& circle);

}  // namespace pharos::host
