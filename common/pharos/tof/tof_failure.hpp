// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::tof {

/// Why a frame has no pose, in the order of stages.
enum class TofFailure : std::uint8_t {
  // frame
  kFrameSize,       // the two images differ, are empty, or are larger than kMaxWidth_px x kMaxHeight_px
  kCameraSize,      // the camera file is for another resolution
  kCameraUnusable,  // focal lengths, depth scale, or a lens model that folds inside the image
  kSaturated,       // most of the image is at full scale
  kNoDepth,         // hardly a pixel has depth
  kStaleRows,       // a part of the rows is that of the last frame
  // ellipses
  kNoEllipses,    // none
  kNoNestedPair,  // no two, one inside the other, of one shape
  // ring
  kNoRingPlane,      // no plane in the depths between any such two
  kRingSize,         // a ring-shaped plane, but smaller or larger than a docking ring, or not circles
  kNoStep,           // surroundings in the same plane: painted
  kRingHidden,       // too little of it is seen
  kRingNotCircles,   // its edges are not where circles in its plane would be
  kRingLeavesImage,  // a part of it is outside
  kRingInconsistent  // edges and depths give different planes
};

/// The stage that failed: "frame", "ellipses", "ring".
const char* stage_of(TofFailure failure);
/// One word for tables: "no_ring_plane".
const char* name_of(TofFailure failure);
/// One line for the operator: the problem and its remedy.
const char* describe(TofFailure failure);

}  // namespace pharos::tof
