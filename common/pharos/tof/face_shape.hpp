// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "pharos/tof/connector_edges.hpp"
#include "pharos/tof/edge_profile.hpp"

namespace pharos::tof {

/// A pixel about a face: its place in the top's plane, and the light that it collects from the top's height, counts.
struct FacePixel {
  Vector2 place_m = Vector2::Zero();
  float layer = 0.0F;   ///< exactly 0: a dark pixel without depth, taken for background
  float weight = 1.0F;  ///< noise of the face's own pixels over this one's

  /// A pixel without depth tells nothing of the noise.
  bool is_measured() const { return layer != 0.0F; }
};

/// Profiles across a face along both its sides' directions.
struct FaceSides {
  EdgeProfile along, across;
  Vector2 first, second;
};

/// The top's brightness and the pixels' scatter, counts.
struct FaceLight {
  double brightness = 0.0, sigma = 0.0;
};

/// Neighbouring pixels share noise: the variance of a mean is wider by this factor (correlated over 1.5 px).
inline constexpr double kFaceCorrelation = 2.0;

/// How far the corners' light is that of the face's rectangle rather than of a disc of its area: least squares of one
/// number, and its deviation, go to the face.
void compare_with_disc(std::span<const FacePixel> pixels, const FaceSides& sides, const FaceLight& light,
                       ConnectorFace& face);

}  // namespace pharos::tof
