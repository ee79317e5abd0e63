// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// How much of a contour the smoothed image has an edge along, roughly: at 32 places, each of one pixel. The mean of
/// the fractions of its length and of its full turn inside the image, as S3 has them; 1 without an image.
///
/// A twentieth of the time of collect_support, whose points give the same fractions exactly.
double glance_along(const Ellipse& ellipse, bool bright_inside, const EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
