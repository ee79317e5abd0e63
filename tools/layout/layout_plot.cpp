// SPDX-License-Identifier: Apache-2.0
#include "tools/layout/layout_plot.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/plot/svg.hpp"

namespace pharos::layout {
namespace {

using tools::Axes;
using tools::PlotPoint;
using tools::Svg;

constexpr double kPanel = 280.0, kPitch = 360.0, kLeft = 60.0, kTop = 50.0;
constexpr const char* kFoundColour = "#1f5fa8";
constexpr const char* kPresentColour = "#d9893b";

std::string shown(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr};
}

/// Blue (good) over white to red (bad).
std::string colour_of(double fraction) {
  const double s = std::clamp(fraction, 0.0, 1.0);
  const auto mix = [s](double blue, double white, double red) {
    return static_cast<int>(s < 0.5 ? blue + (white - blue) * 2.0 * s : white + (red - white) * (2.0 * s - 1.0));
  };
  return "rgb(" + std::to_string(mix(30, 235, 190)) + "," + std::to_string(mix(90, 230, 30)) + "," +
         std::to_string(mix(190, 200, 30)) + ")";
}

/// The body from outside along +`axis`, the other two right and up.
struct View {
  Eigen::Index axis, right, up;
  const char* title;
};

void draw_sensors(Svg& svg, const Axes& axes, const View& view, const Target& target, const char* colour,
                  double radius) {
  for (const SensorPlacement& s : target) {
    if (s.has_normal() && s.normal[view.axis] <= 1e-9) continue;
    svg.circle(axes.at(s.position_m[view.right] * kMmPerM, s.position_m[view.up] * kMmPerM), radius, colour);
  }
}

void draw_body(Svg& svg, double left, const View& view, const ConvexBody& body, const Assessed& found,
               const std::optional<Assessed>& present) {
  const double half_mm = 0.55 * (body.high - body.low).maxCoeff() * kMmPerM;
  const Vector3 middle_mm = 0.5 * (body.low + body.high) * kMmPerM;
  const Axes axes{left,
                  kTop,
                  kPanel,
                  kPanel,
                  middle_mm[view.right] - half_mm,
                  middle_mm[view.right] + half_mm,
                  middle_mm[view.up] - half_mm,
                  middle_mm[view.up] + half_mm};
  draw_axes(svg, axes, view.title, "mm");
  for (const Facet& facet : body.facets) {
    if (facet.normal[view.axis] <= 1e-9) continue;
    std::vector<PlotPoint> outline;
    for (const Vector2& corner : facet.corners) {
      const Vector3 p = facet.at(corner) * kMmPerM;
      outline.push_back(axes.at(p[view.right], p[view.up]));
    }
    svg.polygon(outline, "#f0f0ea", "#808080");
  }
  if (present) draw_sensors(svg, axes, view, present->target, kPresentColour, 5.0);
  draw_sensors(svg, axes, view, found.target, kFoundColour, 4.0);
}

struct Range {
  double low = 0.0, high = 1.0;
};

Range range_of(const std::vector<const Dops*>& all, double Dop::*value) {
  std::vector<double> values;
  for (const Dops* dops : all) {
    for (const auto& dop : *dops) {
      if (dop) values.push_back((*dop).*value);
    }
  }
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  // A percentile, so that single bad poses do not determine the colour scale.
  return {values.front(), std::max(values[values.size() * 95 / 100], values.front() * 1.001 + 1e-12)};
}

void draw_map(Svg& svg, PlotPoint corner, const std::string& title, const std::vector<LighthouseFromBody>& poses,
              const Dops& dops, double Dop::*value, const Range& range) {
  double half_x = 0.5;
  double far = 1.0;
  for (const LighthouseFromBody& pose : poses) {
    half_x = std::max(half_x, 1.1 * std::abs(pose.t.x())), far = std::max(far, 1.1 * pose.t.z());
  }
  const Axes axes{corner.x, corner.y, kPanel, kPanel, -half_x, half_x, 0.0, far};
  draw_axes(svg, axes, title + ", " + shown(range.low) + " (blue) to " + shown(range.high) + " (red)",
            "x, m (up: z, m)");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string colour =
        dops[i] ? colour_of(((*dops[i]).*value - range.low) / (range.high - range.low)) : "black";
    svg.circle(axes.at(poses[i].t.x(), poses[i].t.z()), 4.0, colour);
  }
}

}  // namespace

void plot_layout(const std::string& path, const ConvexBody& body, const std::vector<LighthouseFromBody>& poses,
                 const Assessed& found, const std::optional<Assessed>& present) {
  Svg svg(3.0 * kPitch + kLeft, 3.0 * (kPitch + 20.0));
  const std::array<View, 3> views = {
      {{2, 0, 1, "Along z: x right, y up"}, {0, 1, 2, "Along x: y right, z up"}, {1, 0, 2, "Along y: x right, z up"}}};
  for (std::size_t k = 0; k < views.size(); ++k) {
    draw_body(svg, kLeft + static_cast<double>(k) * kPitch, views[k], body, found, present);
  }
  svg.text({kLeft, 20.0}, present ? "Sensors found: blue; present: orange" : "Sensors found: blue", 14.0);
  std::vector<const Dops*> all = {&found.dops};
  if (present) all.push_back(&present->dops);
  const auto row = [&](double top, const std::string& name, double Dop::*value) {
    const Range range = range_of(all, value);
    draw_map(svg, {kLeft, top}, "Found: " + name, poses, found.dops, value, range);
    if (present) draw_map(svg, {kLeft + kPitch, top}, "Present: " + name, poses, present->dops, value, range);
  };
  row(kTop + kPitch + 20.0, "ADOP deg/rad", &Dop::adop_deg_per_rad);
  row(kTop + 2.0 * (kPitch + 20.0), "PDOP m/rad", &Dop::pdop_m_per_rad);
  svg.write(path);
}

}  // namespace pharos::layout
