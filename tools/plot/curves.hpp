// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/plot/svg.hpp"

namespace pharos::tools {

/// Values over an abscissa; a value that is not finite leaves a gap.
struct Curve {
  std::string name;    ///< in the legend; empty: not there
  std::string colour;  ///< CSS word or "#rrggbb"
  std::vector<PlotPoint> points;
  bool dots = false;  ///< single points instead of a line
};

/// Curves that share one frame.
struct CurvePanel {
  std::string title;  ///< quantity and unit
  std::vector<Curve> curves;
};

/// Panels one below the other over one abscissa, each scaled to its own values, into an SVG file. Throws
/// host::InputError when it cannot be written.
void write_curves(const std::string& path, const std::vector<CurvePanel>& panels, const std::string& x_label);

}  // namespace pharos::tools
