// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/error_plot.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "pharos/base/units.hpp"
#include "tools/plot/svg.hpp"

namespace pharos::evaluate {
namespace {

using tools::Axes;
using tools::PlotPoint;
using tools::Svg;

constexpr std::size_t kMaxPoints = 2000;
constexpr double kWidth = 960.0, kPanelHeight = 240.0, kLeft = 70.0, kTop = 40.0, kPitch = 320.0;
constexpr const char* kErrorColour = "#1f5fa8";
constexpr const char* kSigmaColour = "#d9893b";

struct PanelPoint {
  double time_s = 0.0;
  double error = 0.0;
  std::optional<double> three_sigma;
};

std::vector<PanelPoint> thinned(const std::vector<PanelPoint>& points) {
  const std::size_t stretch = points.size() / kMaxPoints + 1;
  std::vector<PanelPoint> kept;
  for (std::size_t i = 0; i < points.size(); i += stretch) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), i + stretch));
    kept.push_back(
        *std::max_element(begin, end, [](const PanelPoint& a, const PanelPoint& b) { return a.error < b.error; }));
  }
  return kept;
}

template <class Value>
void draw_curve(Svg& svg, const Axes& axes, const std::vector<PanelPoint>& points, double gap_s, const char* colour,
                Value value) {
  std::vector<PlotPoint> run;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && points[i].time_s - points[i - 1].time_s > gap_s) {
      svg.polyline(run, colour);
      run.clear();
    }
    if (const std::optional<double> v = value(points[i])) {
      run.push_back(axes.at(points[i].time_s, std::min(*v, axes.y_high)));
    }
  }
  svg.polyline(run, colour);
}

void draw_panel(Svg& svg, double top, const std::string& title, const std::vector<PanelPoint>& all,
                const Distribution& error, double scale, double gap_s) {
  const std::vector<PanelPoint> points = thinned(all);
  const double begin_s = all.front().time_s;
  const double end_s = std::max(all.back().time_s, begin_s + 1e-3);
  const double high = std::max(1.05 * error.max * scale, 1e-9);
  const Axes axes{kLeft, top, kWidth - kLeft - 20.0, kPanelHeight, begin_s, end_s, 0.0, high};
  draw_axes(svg, axes, title, "time_s of ESTIMATE");
  const double stretch_s = 2.0 * (end_s - begin_s) / static_cast<double>(points.size());
  const double gap = std::max(gap_s, stretch_s);
  draw_curve(svg, axes, points, gap, kSigmaColour, [](const PanelPoint& p) { return p.three_sigma; });
  draw_curve(svg, axes, points, gap, kErrorColour, [](const PanelPoint& p) { return std::optional(p.error); });
  svg.line(axes.at(begin_s, error.rms * scale), axes.at(end_s, error.rms * scale), "#b03030", 1.5, true);
}

std::string title_of(const char* what, const char* unit, const Distribution& error, double scale) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%s error, %s (RMS %.3g, dashed; maximum %.3g; orange: stated 3 sigma)", what,
                unit, error.rms * scale, error.max * scale);
  return text.data();
}

}  // namespace

void plot_errors(const std::string& path, const std::vector<PoseError>& errors, const AllFigures& figures,
                 double max_gap_s) {
  const auto points = [&errors](double scale, auto error, auto sigma) {
    std::vector<PanelPoint> result;
    for (const PoseError& e : errors) {
      result.push_back({e.time_s, scale * (e.*error).norm(), std::nullopt});
      if (e.*sigma) result.back().three_sigma = 3.0 * scale * *(e.*sigma);
    }
    return result;
  };
  Svg svg(kWidth, 2.0 * kPitch);
  draw_panel(svg, kTop, title_of("Attitude", "deg", figures.rotation.error, kDegPerRad),
             points(kDegPerRad, &PoseError::rotation_rad, &PoseError::sigma_rotation_rad), figures.rotation.error,
             kDegPerRad, max_gap_s);
  draw_panel(svg, kTop + kPitch, title_of("Position", "mm", figures.position.error, kMmPerM),
             points(kMmPerM, &PoseError::position_m, &PoseError::sigma_position_m), figures.position.error, kMmPerM,
             max_gap_s);
  svg.write(path);
}

}  // namespace pharos::evaluate
