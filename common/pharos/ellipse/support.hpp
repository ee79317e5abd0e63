// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/ellipse/refine_fit.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Sectors of the contour, of equal eccentric anomaly, in which points are looked for.
inline constexpr int kSectors = 64;

/// What of the image's arcs lies on one ellipse.
struct Support {
  StaticVector<PointF, kMaxFitPoints> points;  ///< evenly taken from all that lie on it
  std::uint32_t stride = 1;                    ///< one in so many was taken
  std::uint32_t count = 0;                     ///< N of (3) and (4): all that lie on it
  std::uint32_t arcs = 0;                      ///< j of (4): arcs with points on it
  double distance_sum_px = 0.0;                ///< sum of L_i of (3)
  double squared_sum_px2 = 0.0;
  double turn_rad = 0.0;      ///< sum of theta_i of (4), over the part of each arc that lies on it
  std::uint64_t sectors = 0;  ///< bit k: sector k has points

  double coverage() const;
};

/// Points of all arcs within `gate_px` of the contour whose gradient is within 25 deg of its normal, on the side told
/// by `bright_inside`.
void collect_support(const Ellipse& ellipse, bool bright_inside, double gate_px, const EllipseWorkspace& workspace,
                     Support& support);

/// Points of one arc that collect_support would take.
std::uint32_t points_on(const Ellipse& ellipse, bool bright_inside, double gate_px, const Arc& arc,
                        const EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
