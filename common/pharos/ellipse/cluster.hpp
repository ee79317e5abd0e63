// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Prasad and Leung's similarity (2010): centres within a tenth of the smaller minor axis, axes within a tenth of each
/// other, directions within a tenth of 180 deg unless both are nearly round (b/a >= 0.9).
bool similar(const Ellipse& one, const Ellipse& other);

/// Whether two found ellipses are one: similar, and with edges closer to each other than those of two contours can be.
/// A docking ring's inner and outer ellipse are similar and stay two.
bool same_ellipse(const DetectedEllipse& one, const DetectedEllipse& other);

/// Adds an ellipse unless a better one of its cluster is present; removes worse ones of its cluster. When full, the
/// worst is removed.
void add_to_clusters(const DetectedEllipse& ellipse, EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
