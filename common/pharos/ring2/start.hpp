// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "pharos/base/static_vector.hpp"
#include "pharos/ring2/cone.hpp"
#include "pharos/ring2/refine.hpp"

namespace pharos::ring2 {

/// The cones over a problem's contours, as [view][circle].
using ConeSet = std::array<std::array<std::optional<Cone>, 2>, kViews>;

/// Empty where an ellipse has no cone.
std::optional<ConeSet> cones_of(const CircleProblem& problem);

/// The two candidates for the circles' common axis: the one in which the ellipses agree best (each has two, and in
/// parallel circles seen twice only the true one is common to all), then the best alternative among the others.
StaticVector<Vector3, 2> candidate_normals(const CircleProblem& problem, const ConeSet& cones);

/// Centre, radii and distance for a given axis: each cone then gives the direction of its centre and the size of its
/// circle per range; linear least squares over the views. Empty where these do not intersect before the cameras with
/// positive radii.
std::optional<CircleModel> model_along(const CircleProblem& problem, const ConeSet& cones, const Vector3& normal);

}  // namespace pharos::ring2
