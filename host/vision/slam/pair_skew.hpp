// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace pharos::slam {

/// Estimates the delay between the right and the left image of a pair.
///
/// Where the target moves up or down in the image, a right image that is late by a fraction of a frame shows it
/// displaced by that fraction of the step. The slope of the row difference over the motion in rows, over many points
/// and some seconds of frames, is the delay in frames. A wrong rectification causes row differences too, but not in
/// proportion to the motion.
class PairSkew {
 public:
  /// Adds one point: its motion in rows since the frame before, and its row in the right image minus that in the left
  /// one, px.
  void add(double moved_px, double off_px);
  /// Ends a frame: reduces the weight of older ones.
  void end_frame();
  /// Delay of the right images in frames (early: below 0), where the motion determines it to a tenth of a frame, or
  /// where it is many sigmas from 0.
  std::optional<double> frames_late() const;

 private:
  double count_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;
  double frames_ = 0.0;
};

}  // namespace pharos::slam
