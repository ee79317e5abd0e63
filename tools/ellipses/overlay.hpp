// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "host/images/canvas.hpp"
#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::tools {

/// Intermediate results of the detection: edge points in grey, each arc in its own colour.
void draw_arcs(const ellipse::EllipseWorkspace& workspace, host::Canvas& canvas);

/// Ellipses with centre, number (their row, from 1) and score; those bright inside in red, those dark inside in sky
/// blue.
void draw_ellipses(std::span<const ellipse::DetectedEllipse> ellipses, host::Canvas& canvas);

}  // namespace pharos::tools
