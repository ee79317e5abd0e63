// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/pointing/segment.hpp"
#include "host/vision/pointing/target_mask.hpp"

namespace pharos::pointing {

/// The target's outline against the sky as straight edges, longest first; segments of one edge are one. Each runs so
/// that the target lies on the positive side of across().
std::vector<Segment> outline_edges(ImageView<const std::uint16_t> image, const TargetMask& target);

/// Segments that continue each other joined: in one line, the same way round, no gap longer than a tenth of what is
/// joined.
std::vector<Segment> joined(std::vector<Segment> segments);

}  // namespace pharos::pointing
