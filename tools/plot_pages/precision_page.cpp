// SPDX-License-Identifier: Apache-2.0
#include "tools/plot_pages/precision_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "pharos/base/units.hpp"
#include "pharos/pose/precision.hpp"
#include "tools/plot_pages/curve_panel.hpp"

namespace pharos::tools {
namespace {

constexpr double kPlaneSide = 380.0, kPlaneMargin = 60.0;
constexpr const char* kNoPose = "#c8c8c8";

// A cell of a plane: across (x or y) and range.
struct Cell {
  double across_m = 0.0, range_m = 0.0;
  std::optional<double> position_mm, attitude_deg;
};

Cell cell_at(const Target& target, const PrecisionVolume& volume, bool vertical, double across_m, double range_m) {
  LighthouseFromBody pose;
  pose.R = Vector3(1.0, -1.0, -1.0).asDiagonal();
  pose.t = vertical ? Vector3(0.0, across_m, range_m) : Vector3(across_m, 0.0, range_m);
  Cell cell{across_m, range_m, std::nullopt, std::nullopt};
  const auto precision = pose::precision_of(target, pose, pose::visible_sensors(target, pose), volume.rho);
  if (!precision) return cell;
  cell.position_mm = precision->pdop_m_per_rad * volume.sigma_rad * kMmPerM;
  cell.attitude_deg = precision->adop_deg_per_rad * volume.sigma_rad;
  return cell;
}

std::vector<Cell> cells_of(const Target& target, const PrecisionVolume& volume, bool vertical) {
  std::vector<Cell> cells;
  for (int i = 0; i < volume.cells; ++i) {
    for (int j = 0; j < volume.cells; ++j) {
      const double across = volume.width_m * ((i + 0.5) / volume.cells - 0.5);
      const double range = volume.min_range_m + (volume.max_range_m - volume.min_range_m) * (j + 0.5) / volume.cells;
      cells.push_back(cell_at(target, volume, vertical, across, range));
    }
  }
  return cells;
}

// From light (small) to dark (large), on a logarithmic scale.
std::string colour_of(double value, const Extent& extent) {
  const double span = std::log(extent.high / extent.low);
  const double at = span > 0.0 ? std::clamp(std::log(value / extent.low) / span, 0.0, 1.0) : 0.0;
  const auto mixed = [at](int light, int dark) { return static_cast<int>(std::lround(light + at * (dark - light))); };
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(mixed(253, 31) & 0xFF),
                static_cast<unsigned>(mixed(231, 12) & 0xFF), static_cast<unsigned>(mixed(183, 72) & 0xFF));
  return text.data();
}

void draw_plane(Svg& svg, double left, const std::string& title, const std::vector<Cell>& cells,
                std::optional<double> Cell::*member, const Extent& extent, const PrecisionVolume& volume) {
  const Axes axes{left,
                  40.0,
                  kPlaneSide - kPlaneMargin - 20.0,
                  kPlaneSide - kPlaneMargin - 20.0,
                  -0.5 * volume.width_m,
                  0.5 * volume.width_m,
                  volume.min_range_m,
                  volume.max_range_m};
  const double half_across = 0.5 * volume.width_m / volume.cells;
  const double half_range = 0.5 * (volume.max_range_m - volume.min_range_m) / volume.cells;
  for (const Cell& cell : cells) {
    const std::string colour = cell.*member ? colour_of(*(cell.*member), extent) : kNoPose;
    const double x = cell.across_m, z = cell.range_m;
    svg.polygon({axes.at(x - half_across, z - half_range), axes.at(x + half_across, z - half_range),
                 axes.at(x + half_across, z + half_range), axes.at(x - half_across, z + half_range)},
                colour, colour);
  }
  draw_axes(svg, axes, title, "m across; upwards: range, m");
}

// The scale: five colours with their values.
void draw_scale(Svg& svg, double left, const Extent& extent) {
  for (int k = 0; k < 5; ++k) {
    const double value = extent.low * std::pow(extent.high / extent.low, k / 4.0);
    const double top = 60.0 + 40.0 * k;
    svg.polygon({{left, top}, {left + 25.0, top}, {left + 25.0, top + 25.0}, {left, top + 25.0}},
                colour_of(value, extent), "#404040");
    svg.text({left + 32.0, top + 17.0}, shown_number(value, 3));
  }
}

}  // namespace

int add_precision(HtmlPage& page, const Target& target, const PrecisionVolume& volume) {
  page.heading("Precision over a volume");
  const std::array<std::vector<Cell>, 2> planes = {cells_of(target, volume, false), cells_of(target, volume, true)};
  int answered = 0;
  for (const auto& plane : planes) {
    answered += static_cast<int>(
        std::count_if(plane.begin(), plane.end(), [](const Cell& cell) { return cell.position_mm.has_value(); }));
  }
  if (answered == 0) return 0;
  for (const auto& [member, what] : {std::pair{&Cell::position_mm, "Sigma of the position, mm"},
                                     std::pair{&Cell::attitude_deg, "Sigma of the attitude, deg"}}) {
    Extent extent;
    for (const auto& plane : planes) {
      for (const Cell& cell : plane) {
        if (cell.*member) extent.add(*(cell.*member));
      }
    }
    Svg svg(2.0 * kPlaneSide + 120.0, kPlaneSide + 20.0);
    draw_plane(svg, kPlaneMargin, "horizontal plane (x, z)", planes[0], member, extent, volume);
    draw_plane(svg, kPlaneSide + kPlaneMargin, "vertical plane (y, z)", planes[1], member, extent, volume);
    draw_scale(svg, 2.0 * kPlaneSide + 20.0, extent);
    page.figure(svg, std::string(what) + ": root of the covariance's trace, of one cycle, from " +
                         shown_number(extent.low, 3) + " to " + shown_number(extent.high, 3) +
                         ". Grey: fewer than three sensors are seen, or they do not determine a pose.");
  }
  return answered;
}

}  // namespace pharos::tools
