// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/ring2/refine.hpp"
#include "pharos/ring2/start.hpp"

namespace pharos::ring2 {

/// Direction from the first circle's centre to the cameras that saw anything, on average.
Vector3 line_of_sight(const CircleProblem& problem, const CircleModel& model);

/// Whether the circles face the cameras so nearly that the tilt's noise (`sigma_rad`) determines its direction: an
/// ellipse changes with the square of the tilt there, and a linearisation about the minimum is wrong.
bool is_face_on(const CircleProblem& problem, const CircleModel& model, double sigma_rad);

/// Mean squared tilt from the model (about tilt_axes, rad^2) over all tilts about the line of sight, each weighted by
/// how well it explains the ellipses: the covariance where the cost is no parabola. Cost: 1.5 ms.
std::optional<Matrix2> tilt_spread(const CircleProblem& problem, const ConeSet& cones, const CircleModel& model,
                                   double chi2, double sigma_rad);

}  // namespace pharos::ring2
