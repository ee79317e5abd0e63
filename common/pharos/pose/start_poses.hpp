// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/static_vector.hpp"
#include "pharos/pose/observation_table.hpp"

namespace pharos::pose {

/// What every start value method answers: poses worth refining, best first where it can tell; empty where it has none.
/// Call shape of all of them: `StartPoses method(const RaySet&)`.
using StartPoses = StaticVector<LighthouseFromBody, 8>;

}  // namespace pharos::pose
