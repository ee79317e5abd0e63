// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "pharos/ellipse/arc.hpp"
#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ellipse/matrix.hpp"

namespace pharos::ellipse {

/// Maximum points that a refinement uses.
inline constexpr std::size_t kMaxFitPoints = 192;

struct RefinedFit {
  Ellipse ellipse;
  Matrix5 covariance = Matrix5::Zero();  ///< of (cx, cy, a, b, theta), as DetectedEllipse::covariance
  double sigma_px = 0.0;                 ///< robust scatter of the points about the contour
};

/// The ellipse of least distance to `points` (at most kMaxFitPoints are used), outliers downweighted (Tukey).
///
/// Gauss-Newton on (cx, cy, (a+b)/2, (a-b)/2 cos 2 theta, (a-b)/2 sin 2 theta), which is not singular at the circle.
/// `independent`: fraction of the points that count as independent measurements, from 0 to 1: neighbours share the
/// noise of their pixels. Empty where the points leave some parameter undetermined.
std::optional<RefinedFit> refine_fit(const Ellipse& start, std::span<const PointF> points, double independent);

}  // namespace pharos::ellipse
