// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/pointing/panel_choice.hpp"
#include "host/vision/pointing/target_mask.hpp"

namespace pharos::pointing {

/// Whether what lies between a pair's edges is one plane of one material: alike in brightness from side to side and
/// from end to end, and along each edge over all of its length. Thin lines (a panel's cells) do not count, nor does a
/// small part that something hides. The faces of a body differ in the sun's angle, its foil from place to place, and a
/// panel from the body beside it. False where the pair is too narrow to tell.
bool is_one_plane(ImageView<const std::uint16_t> image, const TargetMask& target, const EdgePair& pair);

/// Whether what borders a side of a pair also borders `gap`, which is in line with it, all along, on the same side.
bool goes_on_along(ImageView<const std::uint16_t> image, const TargetMask& target, const EdgePair& pair,
                   const Segment& side, const Segment& gap);

}  // namespace pharos::pointing
