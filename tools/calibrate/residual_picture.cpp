// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/residual_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "pharos/base/units.hpp"
#include "tools/calibrate/printf_text.hpp"
#include "tools/plot/svg.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

using calibrate::SensorFit;

// The scale: 0.1 to 1000 arcsec.
constexpr double kLowest_decades = -1.0;
constexpr int kDecades = 4;
// Of the picture.
constexpr double kPanelHeight = 220.0;
constexpr double kPlotHeight = 150.0;
constexpr double kTop = 40.0;
constexpr double kLeft = 60.0;
constexpr double kPerSensor = 28.0;
constexpr double kBar = 10.0;
constexpr const char* kBefore = "#9a9a9a";
constexpr const char* kAfter = "#1f5fa8";
constexpr const char* kGrid = "#dddddd";

void bar(Svg& svg, double x, double floor, double residual_rad, const char* colour) {
  const double decades = std::log10(std::max(residual_rad * kArcsecPerRad, 1e-9)) - kLowest_decades;
  const double top = floor - kPlotHeight * std::clamp(decades / kDecades, 0.0, 1.0);
  svg.polygon({{x, floor}, {x, top}, {x + kBar, top}, {x + kBar, floor}}, colour, colour);
}

void scale(Svg& svg, double floor, double width) {
  for (int decade = 0; decade <= kDecades; ++decade) {
    const double y = floor - kPlotHeight * decade / kDecades;
    svg.line({kLeft, y}, {width - 10.0, y}, kGrid);
    svg.text({kLeft - 6.0, y + 4.0}, printf_text("%g", std::pow(10.0, kLowest_decades + decade)), 12.0, "end");
  }
}

}  // namespace

void write_residual_picture(const calibrate::LighthouseCalibration& calibration, const std::string& path) {
  std::map<std::pair<std::size_t, Axis>, std::vector<const SensorFit*>> panels;
  std::size_t maximum = 1;
  for (const SensorFit& fit : calibration.fits) {
    auto& panel = panels[{fit.station, fit.axis}];
    panel.push_back(&fit);
    maximum = std::max(maximum, panel.size());
  }
  const double width = kLeft + kPerSensor * static_cast<double>(maximum) + 240.0;
  Svg svg(width, kPanelHeight * static_cast<double>(panels.size()));
  double top = 0.0;
  for (const auto& [rotor, fits] : panels) {
    const std::string station = station_id_text(calibration.bundle.unknowns.station[rotor.first].id);
    svg.text({kLeft, top + 22.0}, "Station " + station + ", rotor " + name_of(rotor.second) +
                                      ": rms residual in arcsec, by sensor, before (grey) and after (blue)");
    const double floor = top + kTop + kPlotHeight;
    scale(svg, floor, width);
    double x = kLeft + 6.0;
    for (const SensorFit* fit : fits) {
      bar(svg, x, floor, fit->before_rad, kBefore);
      bar(svg, x + kBar, floor, fit->after_rad, kAfter);
      svg.text({x + kBar, floor + 16.0}, std::to_string(fit->sensor), 12.0, "middle");
      x += kPerSensor;
    }
    top += kPanelHeight;
  }
  svg.write(path);
}

}  // namespace pharos::tools
