// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "pharos/base/static_vector.hpp"
#include "pharos/ellipse/refine_fit.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// The points of the image's arcs that lie on one ellipse.
struct Support {
  StaticVector<PointF, kMaxFitPoints> points;            ///< evenly taken from all that lie on it
  StaticVector<std::uint8_t, kMaxFitPoints> sectors;     ///< of the contour in which each of them lies
  StaticVector<float, kMaxFitPoints> squared_gradients;  ///< at each of them
  int sector_count = 0;                                  ///< of the whole contour
  std::uint64_t beside_gaps = 0;    ///< a bit for each sector near one of those where the contour is hidden
  std::uint32_t stride = 1;         ///< one in so many was taken
  std::uint32_t count = 0;          ///< N of (3) and (4): all that lie on it
  std::uint32_t arcs = 0;           ///< j of (4): arcs with points on it
  double distance_sum_px = 0.0;     ///< sum of L_i of (3)
  double squared_gradient = 0.0;    ///< mean of the points'
  double gradient_variation = 0.0;  ///< deviation of the squared gradients over their mean
  double length_fraction = 0.0;     ///< of the contour's length, in sectors that have points
  double turn_fraction =
      0.0;  ///< of the contour's full turn, in sectors that have points: sum of theta_i of (4) / 2 pi
  double inside_fraction = 1.0;  ///< of the contour's length, inside the image
  double inside_turn = 1.0;      ///< of its full turn, inside the image

  /// Fraction of the points that count as independent measurements.
  double independent() const;

  void clear() {
    points.clear();
    sectors.clear();
    squared_gradients.clear();
    beside_gaps = 0;
    stride = 1;
    count = arcs = 0;
    distance_sum_px = squared_gradient = gradient_variation = length_fraction = turn_fraction = 0.0;
    inside_fraction = inside_turn = 1.0;
  }
};

/// Points of all arcs within `gate_px` of the contour whose gradient is within 25 deg of its normal, on the side given
/// by `bright_inside`.
void collect_support(const Ellipse& ellipse, bool bright_inside, double gate_px, const EllipseWorkspace& workspace,
                     Support& support);

/// Marks the arcs of which at least `fraction` lies on the contour, by the rule of collect_support; marks stay.
void mark_arcs_on(const Ellipse& ellipse, bool bright_inside, double gate_px, double fraction,
                  const EllipseWorkspace& workspace, std::span<bool> marked);

}  // namespace pharos::ellipse
