// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tools/layout/convex_body.hpp"
#include "tools/layout/layout_score.hpp"

namespace pharos::layout {

/// A layout and its precision factors at each pose.
struct Assessed {
  Target target;
  Dops dops;
};

/// Draws the body with the new sensors and, where given, the present ones, in three views along its axes, and ADOP and
/// PDOP over the volume (poses seen from above, station at the bottom). Throws host::InputError when the file cannot be
/// written.
void plot_layout(const std::string& path, const ConvexBody& body, const std::vector<LighthouseFromBody>& poses,
                 const Assessed& found, const std::optional<Assessed>& present);

}  // namespace pharos::layout
