// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Moves an ellipse back from other edges within the blur's reach, as the smoothed image shows them along the contour's
/// normals, and widens its covariance: an edge pushes one of opposite step away and pulls one of like step, and need
/// not be an ellipse's itself (the inside of a narrow ring, a line beside a dot).
///
/// Nothing where the workspace has no image.
void move_from_near_edges(DetectedEllipse& found, const EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
