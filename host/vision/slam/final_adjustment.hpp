// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "host/vision/slam/steady_rotation.hpp"

namespace pharos::slam {

/// Solution of (12) for a whole map.
struct FinalAdjustment {
  BundleProblem problem;
  std::vector<std::size_t> rejected;     ///< observations' numbers
  KeyframeCovariances covariances;       ///< relative to the first keyframe
  std::optional<SteadyRotation> steady;  ///< on which all attitudes are
  KeyframePoses free;                    ///< where they are: the poses without it
};

/// Takes the rotation as steady where no attitude of a solution without it contradicts it (max_deviation); false, and
/// the solution as it was, where one does, or with fewer than kMinSteadyKeyframes. Covariances are then those without
/// it, and what it moved (add_deviations). `times_s` has every keyframe.
bool take_steady_rotation(const std::map<KeyframeId, double>& times_s, const StereoCamera& camera,
                          FinalAdjustment& solution);

/// Adjusts a map with two keyframes or more; with `try_steady` as a steady rotation where it can be.
FinalAdjustment adjust_finally(const Map& map, const StereoCamera& camera, bool try_steady);

}  // namespace pharos::slam
