// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/hits.hpp"
#include "pharos/pose/refine.hpp"
#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// Largest chi-squared that white noise of sigma gives a sound fit of so many degrees of freedom, but for one in ten
/// thousand: what needs no search for outliers.
double credible_chi2(int degrees_of_freedom);

/// Chooses hits, and leaves out those that fit no rigid body, from as many starts as it takes.
///
/// Least trimmed squares (Rousseeuw): every start pose picks the best hit of each place, keeps the two thirds that fit
/// best (at least seven rows: six unknowns and one to check them), takes a Gauss-Newton step and picks again; the start
/// whose core ends with the least sum of squares wins. Starts are the given poses and P3P over at most kMaxTriplets
/// triplets and the hits of each: no product over sensors. Then hits outside the core are let in again while they lie
/// within a gate relative to the larger of sigma and the core's own scale, because real data has systematic errors
/// of twenty sigma that are no reason to throw a hit away.
///
/// Leaves the choice in `hits` and the pose in `pose`; false where no start was found.
bool fit_rigid_body(Hits& hits, const StartPoses& starts, const SolveOptions& options, LighthouseFromBody& pose);

}  // namespace pharos::pose
