// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::pointing {

/// Why an image has no result.
enum class PointingRefusal : std::uint8_t {
  kWrongSize,      // not the camera file's
  kBlack,          // no signal above the noise
  kSaturated,      // the target is overexposed: its edges are displaced
  kStarsOnly,      // spots, none of them large enough for a target
  kStarsBrighter,  // no panel, and a small object is brighter than the target
  kNoPanel,        // a target without two parallel edges against the sky
  kOneEdge,        // one long edge without a parallel one
  kCutByBorder,    // an edge runs into the image's border
  kEdgeUnsure,     // an edge that is no straight line once seen closely
  kAlongSight,     // the panel's axis is within 10 deg of the line of sight
  kOutsideLens,    // an edge where the camera file's lens model has no rays
};
const char* name_of(PointingRefusal refusal);
/// Message for the user: the meaning and what to do.
const char* advice_of(PointingRefusal refusal);

}  // namespace pharos::pointing
