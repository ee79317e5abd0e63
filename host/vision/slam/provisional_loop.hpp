// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "host/vision/slam/loop_evidence.hpp"

namespace pharos::slam {

/// A keyframe that shows another part of the map: a loop.
struct Loop {
  KeyframeId here = kNone;
  KeyframeId there = kNone;
  CameraFromTarget corrected;            ///< pose of `here` if that of `there` is right
  Matrix6 covariance = Matrix6::Zero();  ///< of `corrected`, as a covariance of zeta (place_gate.hpp)
  /// Features of `here` and the matching points of `there`'s side.
  std::vector<std::pair<int, PointId>> seen;
  /// Points of `there`'s side whose patches were aligned, by keyframe: `here` and those that confirmed the loop.
  std::map<KeyframeId, std::vector<AlignedPoint>> aligned;
};

/// A loop that was accepted and waits for the next keyframes. The map is not changed until they confirm it.
///
/// Where the loop is right, points of the place are found as readily as those of the keyframe's own surroundings; of an
/// alike part of the body only those that are alike. A keyframe is heard where it looks from within 20 deg of one at
/// the place: from farther off points look different.
class ProvisionalLoop {
 public:
  explicit ProvisionalLoop(Loop loop) : loop_(std::move(loop)) {}

  enum class Verdict {
    kOpen,
    kConfirmed,
    kContradicted,
    kDropped,  ///< one of its keyframes was removed from the map, or 20 keyframes did not decide
  };
  /// A keyframe agrees where it finds the place at the pose that the loop expects, by 20 inliers, and of the place's
  /// points that it should see at least half the fraction that it finds of its neighbours' points. Two that agree
  /// confirm the loop, two that do not contradict it.
  /// `pyramid`: see fit_place().
  Verdict hear(const Map& map, KeyframeId id, const StereoCamera& camera,
               const std::vector<PyramidLevel>& pyramid = {});
  const Loop& loop() const { return loop_; }

 private:
  Loop loop_;
  int asked_ = 0, agreed_ = 0, disagreed_ = 0;
};

}  // namespace pharos::slam
