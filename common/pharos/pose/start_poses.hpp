// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/static_vector.hpp"
#include "pharos/pose/observation_table.hpp"

namespace pharos::pose {

/// Result of every start method: poses to refine, best first where the method ranks them; empty where it has none.
/// Common signature: `StartPoses method(const RaySet&)`.
using StartPoses = StaticVector<LighthouseFromBody, 8>;

}  // namespace pharos::pose
