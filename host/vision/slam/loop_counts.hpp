// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::slam {

/// What became of the candidates that visual words proposed, and of the loops accepted of them.
struct LoopCounts {
  int candidates = 0;
  int geometry = 0;     ///< refused: too few points fit one pose
  int trajectory = 0;   ///< refused: the pose contradicts the trajectory and its covariance
  int one_surface = 0;  ///< refused: the points are on one plane, whose texture may repeat
  int neighbours = 0;   ///< refused: the keyframe's neighbours do not show the place
  int rival = 0;        ///< refused: another candidate asks for another pose
  int taken_back = 0;   ///< accepted, then contradicted by the next keyframes
};

}  // namespace pharos::slam
