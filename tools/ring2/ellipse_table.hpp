// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/table/byte_source.hpp"
#include "pharos/ring2/solve.hpp"

namespace pharos::tools {

/// What an ellipse's edge points are taken to have where the table does not say: one a pixel of contour, each good to
/// this.
inline constexpr double kUsualSigma_px = 0.1;

/// The ellipses of one instant.
struct EllipseProblem {
  std::string name;
  ring2::ContourSet contours;
};

struct EllipseTable {
  bool has_problems = false;  ///< the table has a column `problem`
  std::vector<EllipseProblem> problems;
};

/// Reads `[problem,]view,feature,cx_px,cy_px,a_px,b_px,theta_rad[,sigma_px,points]`. Rows of a problem may stand in any
/// order; problems keep that of their first rows. Throws InputError naming file, line and column: axes that are none, a
/// view or feature that is neither, an ellipse given twice.
EllipseTable read_ellipse_table(host::ByteSource source);

}  // namespace pharos::tools
