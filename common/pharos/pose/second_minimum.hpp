// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/observation_table.hpp"

namespace pharos::pose {

/// The attitude that looks nearly the same from afar: the body's plane of best fit mirrored in depth.
///
/// A far station sees the sensors nearly in parallel projection, which does not distinguish depths d from -d. Of the
/// sensors' plane of best fit (normal n in the lighthouse frame, sight line s to the centroid) the mirror image in
/// depth is the rigid rotation by twice the angle from n to s about n x s, R' = (I - 2 s s^T)(I - 2 n n^T) R, which
/// leaves the centroid unchanged (Schweighofer and Pinz, PAMI 2006; Collins and Bartoli, IJCV 2014). It is exact for
/// coplanar sensors in the far limit and close wherever the relief is small enough for a second minimum to fit.
LighthouseFromBody mirrored_in_depth(const ObservationTable& table, const LighthouseFromBody& pose);

}  // namespace pharos::pose
