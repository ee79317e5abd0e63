// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/pointing/segment.hpp"
#include "host/vision/pointing/target_mask.hpp"

namespace pharos::pointing {

/// The target's outline against the sky as straight edges, longest first; segments of one edge are joined. Each is
/// oriented with the target on the positive side of across().
std::vector<Segment> outline_edges(ImageView<const std::uint16_t> image, const TargetMask& target);

/// Joins collinear segments of the same orientation, with gaps of at most a tenth of the joined length.
std::vector<Segment> joined(std::vector<Segment> segments);

}  // namespace pharos::pointing
