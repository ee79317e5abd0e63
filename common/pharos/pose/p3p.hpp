// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/start_poses.hpp"
#include "pharos/pose/triplet.hpp"

namespace pharos::pose {

/// Poses under which three sensors lie on their rays: up to four.
///
/// With distances l_i along unit rays and c_ij the cosine between two of them, each pair of sensors gives the conic
/// l_i^2 + l_j^2 - 2 c_ij l_i l_j = |b_i - b_j|^2. Two homogeneous combinations (D1, D2 as in Persson and Nordberg,
/// "Lambda Twist", ECCV 2018) meet in up to four points; a degenerate member D1 + g D2 of their pencil, det = 0, splits
/// into two lines through those points (Ding et al., "Revisiting the P3P Problem", CVPR 2023), each of which meets D1
/// in the roots of a quadratic.
///
/// Near the fronto-parallel pose noise may leave no real root at all; the real parts are returned then, because the two
/// minima lie on either side of them: the most ordinary view must not be left without a start value.
StartPoses p3p(const RaySet& set, const Triplet& triplet);

}  // namespace pharos::pose
