// SPDX-License-Identifier: Apache-2.0
#include "tools/plot_pages/curve_panel.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tools {
namespace {

constexpr std::size_t kMaxPoints = 2000;
constexpr double kLeft = 80.0, kRight = 20.0, kTop = 30.0, kHeight = 140.0;
constexpr double kGapMedians = 10.0;
constexpr const char* kCurveColour = "#1f5fa8";
constexpr const char* kBandColour = "#f3d9be";

std::vector<BandPoint> thinned(const std::vector<BandPoint>& points) {
  double mean = 0.0;
  for (const BandPoint& point : points) mean += point.value / static_cast<double>(points.size());
  const std::size_t stride = points.size() / kMaxPoints + 1;
  std::vector<BandPoint> kept;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), i + stride));
    kept.push_back(*std::max_element(begin, end, [mean](const BandPoint& a, const BandPoint& b) {
      return std::abs(a.value - mean) < std::abs(b.value - mean);
    }));
  }
  return kept;
}

// Parts without gaps.
std::vector<std::vector<BandPoint>> parts_of(const std::vector<BandPoint>& points) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < points.size(); ++i) steps.push_back(points[i].time_s - points[i - 1].time_s);
  double gap_s = 0.0;
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    gap_s = kGapMedians * *middle;
  }
  std::vector<std::vector<BandPoint>> parts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || points[i].time_s - points[i - 1].time_s > gap_s) parts.emplace_back();
    parts.back().push_back(points[i]);
  }
  return parts;
}

void draw_band(Svg& svg, const Axes& axes, const std::vector<BandPoint>& part) {
  std::vector<PlotPoint> outline, back;
  const auto clamped = [&axes](double y) { return std::clamp(y, axes.y_low, axes.y_high); };
  for (const BandPoint& point : part) {
    if (!point.band) return;
    outline.push_back(axes.at(point.time_s, clamped(point.band_centre + *point.band)));
    back.push_back(axes.at(point.time_s, clamped(point.band_centre - *point.band)));
  }
  outline.insert(outline.end(), back.rbegin(), back.rend());
  svg.polygon(outline, kBandColour, kBandColour);
}

}  // namespace

void Extent::add(double value) {
  low = any ? std::min(low, value) : value;
  high = any ? std::max(high, value) : value;
  any = true;
}

void Extent::widen(double fraction, double least) {
  const double more = std::max(fraction * (high - low), 0.5 * std::max(0.0, least - (high - low)));
  low -= more;
  high += more;
}

void draw_band_panel(Svg& svg, double top, const std::string& title, const std::vector<BandPoint>& points) {
  if (points.empty()) return;
  const std::vector<BandPoint> kept = thinned(points);
  Extent times, values;
  for (const BandPoint& point : kept) {
    times.add(point.time_s);
    values.add(point.value);
    if (!point.band) continue;
    values.add(point.band_centre - *point.band);
    values.add(point.band_centre + *point.band);
  }
  times.widen(0.0, 1e-3);
  values.widen(0.05, 1e-9 + 1e-6 * std::max(std::abs(values.low), std::abs(values.high)));
  const Axes axes{kLeft,      top + kTop, kPanelWidth - kLeft - kRight, kHeight, times.low, times.high,
                  values.low, values.high};
  draw_axes(svg, axes, title, "time, s after the first row");
  const auto parts = parts_of(kept);
  for (const auto& part : parts) draw_band(svg, axes, part);
  for (const auto& part : parts) {
    std::vector<PlotPoint> line;
    for (const BandPoint& point : part) line.push_back(axes.at(point.time_s, point.value));
    svg.polyline(line, kCurveColour);
    if (line.size() == 1) svg.circle(line.front(), 1.5, kCurveColour);
  }
}

}  // namespace pharos::tools
