// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/hit_candidates.hpp"
#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// How a search ended: on a pose or with all tried; without any start; or at its limit, before completion.
enum class Search : std::uint8_t { kDone, kNoStart, kCutShort };

/// Chooses hits, and leaves out those that fit no rigid body, from as many starts as needed.
///
/// Least trimmed squares (Rousseeuw and Van Driessen 2006): every start pose picks the best hit of each place, keeps
/// the two thirds of the places that fit best, takes a Gauss-Newton step and picks again; the start whose core ends
/// with the minimum sum of squares wins. Starts are the given poses, then P3P over at most kMaxTriplets triplets of
/// sensors and the hits of each: no product over all sensors. The search ends at the first pose that all places agree
/// on, or after options.max_search_starts. Leaves the choice in `hits` and the best pose in `pose`. Cost: 5 us where
/// the first start suffices, some 100 us where hits must be left out.
Search fit_rigid_body(HitCandidates& hits, const StartPoses& starts, const SolveOptions& options,
                      LighthouseFromBody& pose);

/// Second half of it: from a pose and its core, admits hits while they lie within a gate relative to the larger of
/// sigma and the fit's own scale, because real data has systematic errors of twenty sigma that must not remove a hit.
void readmit_inliers(HitCandidates& hits, const SolveOptions& options, LighthouseFromBody& pose);

}  // namespace pharos::pose
