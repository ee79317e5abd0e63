// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/tof/ring_pixels.hpp"

namespace pharos::tof {

/// The most probable step of the ring's unknowns from a model, by the pixels about it and what was known before.
struct RingLight {
  Vector7 step = Vector7::Zero();
  Matrix7 covariance = Matrix7::Zero();
  /// What the light from behind, that blur mixes into the ring's pixels, does to the plane of their depths: its height
  /// over the true one is x + y X + z Y at (X, Y) along axes_of from the ring's middle, m and m/m.
  Vector3 plane_bias = Vector3::Zero();
  std::int32_t pixels = 0;
};
/// What is known of the step beforehand: information * step = right.
struct RingKnowledge {
  Matrix7 information = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
};

/// Sums over the pixels of one direction, of which only the profile differs. Unknowns: the two edges' places, the blur,
/// the two walls' brightness; and the face's light, which sectors have of their own.
struct RingDirectionSums {
  Eigen::Matrix<double, 5, 5> normal;
  Eigen::Matrix<double, 5, 1> right, with_light;
  double light_square = 0.0, light_right = 0.0;
};

struct RingLightWorkspace : RingPixels {
  std::array<RingDirectionSums, kRingDirections> sums;
  double blur_px = 0.0;  ///< of lens and pixel together, standard deviation
  std::array<float, kMaxRingPixels> sizes;
};

/// The pixels within some px of the ring's edges, by the light that comes from the ring's height (layer_intensity.hpp):
/// a bar of the ring's width, blurred, with the walls in sight beside it. Unknown beside the ring's own seven: the
/// blur, the brightness of the outer and of the inner wall, and the face's brightness sector by sector. Pixels without
/// depth are left out, whatever they would have said. Nothing where too few pixels are seen.
///
/// The blur so found also tells how much of what lies behind is mixed into the pixels of the plane's fit, those
/// `margin_px` within both edges: of a ring 4 px wide no pixel is the ring's alone.
std::optional<RingLight> fit_ring_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                        const RingModel& model, const RingPrior& prior, const RingKnowledge& known,
                                        double margin_px, RingLightWorkspace& workspace);

}  // namespace pharos::tof
