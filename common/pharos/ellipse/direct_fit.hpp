// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "pharos/ellipse/arc.hpp"
#include "pharos/ellipse/ellipse.hpp"

namespace pharos::ellipse {

/// The ellipse of least algebraic distance to at least six points: Fitzgibbon's constraint 4AC - B^2 = 1 in the split
/// form of Halir and Flusser (1998), on points moved to their mean and scaled to unit size.
///
/// Empty where no ellipse fits (points on a line, a hyperbola's branch). Biased to small ellipses for short arcs:
/// refine.
std::optional<Ellipse> fit_direct(std::span<const PointF> points);

}  // namespace pharos::ellipse
