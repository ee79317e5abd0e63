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

/// Blur moves the edge of a disc of radius r inwards by sigma^2 / 2r (the steepest place of a blurred disc: its profile
/// falls as r^-1/2 exp(-(r - R)^2 / 2 sigma^2)). The variances that edges are found through: the filter 1, the central
/// difference 1/3, the pixel 1/12, and a lens of 0.7 px.
inline constexpr double kBlurVariance_px2 = 1.0 + 1.0 / 3.0 + 1.0 / 12.0 + 0.7 * 0.7;
/// Nobody tells the lens: 0.5 to 0.9 px (1 sigma) in the variance of the blur. Axes are uncertain by its effect.
inline constexpr double kBlurSpread_px2 = 0.25;
/// The blur's variance for two edges near each other: the parabola through a pixel's neighbours takes a third of the
/// third derivative into its slope, as a blur of variance 1/3 does. On a disc's profile that cancels.
inline constexpr double kFlankVariance_px2 = kBlurVariance_px2 + 1.0 / 3.0;

struct RefinedFit {
  Ellipse ellipse;
  Matrix5 covariance = Matrix5::Zero();  ///< of (cx, cy, a, b, theta), as DetectedEllipse::covariance
  double sigma_px = 0.0;                 ///< robust scatter of the points about the contour as blur shows it
  double rms_px = 0.0;                   ///< of all points' distances from there
};

/// The ellipse of least distance to `points` (at most kMaxFitPoints are used), outliers downweighted (Tukey).
///
/// Gauss-Newton on (cx, cy, (a+b)/2, (a-b)/2 cos 2 theta, (a-b)/2 sin 2 theta), which is not singular at the circle.
/// `independent`: fraction of the points that count as independent measurements, from 0 to 1: neighbours share the
/// noise of their pixels. Empty where the points leave some parameter undetermined.
std::optional<RefinedFit> refine_fit(const Ellipse& start, std::span<const PointF> points, double independent);

/// Adds to the covariance what the points' noise does not explain of the scatter of eight fits, each without an octant
/// of the contour (the jackknife with deleted groups): where the contour is no ellipse, errors of neighbouring points
/// are alike. `points` are those of the fit.
void add_jackknife(std::span<const PointF> points, RefinedFit& fit);

}  // namespace pharos::ellipse
