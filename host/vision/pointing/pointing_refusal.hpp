// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::pointing {

/// Why an image has no answer.
enum class PointingRefusal : std::uint8_t {
  kWrongSize,      // not the camera file's
  kBlack,          // nothing stands out of the noise
  kSaturated,      // the target is overexposed: its edges are not where they seem
  kStarsOnly,      // spots, none of them large enough for a target
  kStarsBrighter,  // no panel, and something small outshines what is there
  kNoPanel,        // a target without two parallel edges against the sky
  kOneEdge,        // one long edge without a parallel one
  kCutByBorder,    // an edge runs into the image's border
  kEdgeUnsure,     // an edge that is no straight line once seen closely
  kOutsideLens,    // an edge where the camera file's lens model has no rays
};
const char* name_of(PointingRefusal refusal);
/// For people: what it means and what to do.
const char* advice_of(PointingRefusal refusal);

}  // namespace pharos::pointing
