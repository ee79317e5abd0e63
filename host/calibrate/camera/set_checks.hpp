// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/camera/board_bundle.hpp"
#include "host/calibrate/camera/coverage.hpp"

namespace pharos::calibrate {

/// Fewer images do not determine a camera reliably.
inline constexpr int kMinViews = 3;

/// Why an adjusted set of views does not determine a camera, and what to do, as text; empty where it does: poses
/// differ, normals differ, focal lengths and principal point are known to 1 %.
std::string what_is_degenerate(const BundleOutcome& outcome);

/// What an otherwise sufficient set of views leaves uncertain about camera number `camera`: parts of the image without
/// points, large uncertainty of distortion in the corners, k3 where it was held fixed.
std::vector<std::string> what_is_unobservable(const BundleOutcome& outcome, std::size_t camera,
                                              const Coverage& coverage, bool fixed_k3);

}  // namespace pharos::calibrate
