// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "pharos/base/image_view.hpp"
#include "pharos/ellipse/contours.hpp"
#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ellipse/settings.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Ellipses whose edges are visible in the image, best score first (paper 000, 2.2.1).
///
/// `image`: grey values of any scale; thresholds adapt. Concentric ellipses with distinct edges are returned as two.
/// Images smaller than kMinSide_px, larger than kMaxSide_px or than the workspace's planes give no ellipse. The result
/// lies in the workspace and is valid until its next use.
std::span<const DetectedEllipse> detect_ellipses(ImageView<const std::uint16_t> image, const EllipseSettings& settings,
                                                 EllipseWorkspace& workspace);

/// The two halves of detect_ellipses, for callers that need each. First: edge points along contours; none in images of
/// an invalid size.
void trace_contours(ImageView<const std::uint16_t> image, EllipseWorkspace& workspace, Contours& contours);
/// Second: arcs and ellipses of the contours that were just traced.
std::span<const DetectedEllipse> ellipses_along(const Contours& contours, const EllipseSettings& settings,
                                                EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
