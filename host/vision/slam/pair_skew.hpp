// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace pharos::slam {

/// Tells whether the right image of a pair was taken when the left one was.
///
/// Where the target moves up or down in the image, a right image that is late by a share of a frame shows it that share
/// of the step farther on, in another row. The slope of rows off over rows moved, over many points and some seconds of
/// frames, is the delay in frames. A wrong rectification puts rows off too, but not in proportion to what moves.
class PairSkew {
 public:
  /// One point: how many rows it moved since the frame before, and how many rows below the left one the right image
  /// has it, px.
  void add(double moved_px, double off_px);
  /// All points of a frame are in; what is old fades.
  void end_frame();
  /// Frames by which the right images are late (early: below 0), where enough moved to tell it to a tenth of a frame,
  /// or where it is many sigmas from 0.
  std::optional<double> frames_late() const;

 private:
  double count_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;
  double frames_ = 0.0;
};

}  // namespace pharos::slam
