// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/target.hpp"
#include "tools/plot_pages/html_page.hpp"

namespace pharos::tools {

/// A volume before a station: at each range, squares of this width, cut into cells.
struct PrecisionVolume {
  double min_range_m = 1.0;
  double max_range_m = 6.0;
  double width_m = 4.0;
  int cells = 24;  // along range and width
  double sigma_rad = 0.0;
  double rho = 0.0;
};

/// Sigmas of position and attitude, (24) of paper 002, of a target whose z axis looks at the station's plane: R =
/// diag(1, -1, -1), in the horizontal plane through the station's axis (x, z) and in the vertical one (y, z). Returns
/// the number of cells with a pose; cells without one are grey.
int add_precision(HtmlPage& page, const Target& target, const PrecisionVolume& volume);

}  // namespace pharos::tools
