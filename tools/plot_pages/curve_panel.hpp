// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/plot/svg.hpp"

namespace pharos::tools {

/// A value at a time, and a band of +-`band` about `band_centre`, where one is stated.
struct BandPoint {
  double time_s = 0.0;
  double value = 0.0;
  double band_centre = 0.0;
  std::optional<double> band;
};

/// Draws one panel: the band (light) behind the curve, both broken where the time between points is more than ten
/// times the median. At most 2000 points: of each interval the one furthest from the mean, so that no peak is lost.
void draw_band_panel(Svg& svg, double top, const std::string& title, const std::vector<BandPoint>& points);

inline constexpr double kPanelWidth = 960.0, kPanelPitch = 210.0;

/// From the smallest to the largest value, widened where they are equal.
struct Extent {
  double low = 0.0, high = 0.0;
  bool any = false;

  void add(double value);
  /// By `fraction` of its width on both sides; at least `least` wide.
  void widen(double fraction, double least);
};

}  // namespace pharos::tools
