// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/camera/board_bundle.hpp"
#include "host/calibrate/camera/coverage.hpp"

namespace pharos::calibrate {

/// Fewer images cannot tell a camera with any certainty.
inline constexpr int kMinViews = 3;

/// Why an adjusted set of views says too little about a camera, in words with what to do; empty where it says enough:
/// poses that differ, normals that differ, focal lengths and principal point known to 1 %.
std::string what_is_degenerate(const BundleOutcome& outcome);

/// What the views could not tell about camera number `camera`, though they tell enough: parts of the image without
/// points, distortion known badly in the corners, k3 where it was held.
std::vector<std::string> what_is_unobservable(const BundleOutcome& outcome, std::size_t camera,
                                              const Coverage& coverage, bool fixed_k3);

}  // namespace pharos::calibrate
