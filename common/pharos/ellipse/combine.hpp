// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/settings.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Arcs, alone and in pairs that may belong together, to ellipses: fitted, completed with every other arc that lies on
/// the fit, refined, scored and clustered. Fills workspace.found.
void combine_arcs(const EllipseSettings& settings, EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
