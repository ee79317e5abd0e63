// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/ring_light_sums.hpp"

namespace pharos::tof {

using Matrix37 = Eigen::Matrix<double, 3, 7>;

/// What is known of the step beforehand, by the plane of the depths: by_step * step = offset + by_bias * bias.
struct RingKnowledge {
  Matrix37 by_step = Matrix37::Zero();
  Matrix3 information = Matrix3::Zero();
  Vector3 offset = Vector3::Zero();
  Matrix3 by_bias = Matrix3::Zero();
};

/// Light of upright walls over that of the face by the cosine law, both walls of the ring together. Another paint,
/// another finish: before anything is seen it is 1 +- 0.5.
struct WallLight {
  double ratio = 1.0;
  double variance = 0.25;
};

/// The most probable step of the ring's unknowns from a model, by the pixels about it and what was known before.
struct RingLight {
  Vector7 step = Vector7::Zero();
  Matrix7 covariance = Matrix7::Zero();
  /// What the light from behind, that blur mixes into the ring's pixels, does to the plane of their depths: its height
  /// over the true one is x + y X + z Y at (X, Y) along axes_of from the ring's middle, m and m/m. It is subtracted.
  Vector3 plane_bias = Vector3::Zero();
  double plane_chi2 = 0.0;  ///< disagreement with what was known: three degrees of freedom
  WallLight walls;
};

struct RingLightWorkspace : RingPixels {
  RingLightColumns columns;
  double blur_px = 0.0;  ///< of lens and pixel together, standard deviation
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
