// SPDX-License-Identifier: Apache-2.0
#include "tools/plot_pages/pose_pages.hpp"

#include <algorithm>
#include <array>

#include "pharos/base/units.hpp"
#include "tools/plot_pages/curve_panel.hpp"

namespace pharos::tools {
namespace {

using evaluate::EstimatePose;
using evaluate::PoseError;
using Samples = evaluate::Trajectory<EstimatePose>;

constexpr double kSigmas = 3.0;
constexpr double kPathSide = 300.0, kPathMargin = 55.0;
constexpr const char* kBandWords =
    " Band: three times the stated sigma, the root of the covariance's trace, which no axis exceeds; none where the "
    "table states no sigma.";

// Same scale on both axes.
void draw_projection(Svg& svg, double left, const Samples& samples, int across, int up, const char* title) {
  Extent x, y;
  for (const auto& sample : samples) {
    x.add(sample.pose.t[across]);
    y.add(sample.pose.t[up]);
  }
  const double width = std::max({x.high - x.low, y.high - y.low, 1e-3});
  x.widen(0.05, 1.1 * width);
  y.widen(0.05, 1.1 * width);
  const Axes axes{left,  30.0,  kPathSide - kPathMargin - 10.0, kPathSide - kPathMargin - 10.0, x.low, x.high,
                  y.low, y.high};
  draw_axes(svg, axes, title, "m");
  std::vector<PlotPoint> line;
  const std::size_t stride = samples.size() / 4000 + 1;
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    line.push_back(axes.at(samples[i].pose.t[across], samples[i].pose.t[up]));
  }
  svg.polyline(line, "#1f5fa8");
  svg.circle(axes.at(samples.front().pose.t[across], samples.front().pose.t[up]), 4.0, "#2f8f4e");
  svg.circle(axes.at(samples.back().pose.t[across], samples.back().pose.t[up]), 4.0, "#b03030");
}

// A vector at a time, with its sigma.
struct VectorPoint {
  double time_s = 0.0;
  Vector3 vector = Vector3::Zero();
  std::optional<double> sigma;
};

// Where the band lies: about the curve, or about zero, where the curve is an error.
enum class BandAbout { kCurve, kZero };

// Three panels, x, y and z over time.
Svg vector_panels(const std::vector<VectorPoint>& items, const std::string& what, BandAbout about) {
  Svg svg(kPanelWidth, 3.0 * kPanelPitch);
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<BandPoint> points;
    for (const VectorPoint& item : items) {
      const double value = item.vector[axis];
      points.push_back({item.time_s - items.front().time_s, value, about == BandAbout::kCurve ? value : 0.0,
                        item.sigma ? std::optional(kSigmas * *item.sigma) : std::nullopt});
    }
    draw_band_panel(svg, axis * kPanelPitch, std::string(kAxes[static_cast<std::size_t>(axis)]) + ": " + what, points);
  }
  return svg;
}

std::optional<double> scaled(const std::optional<double>& sigma, double scale) {
  return sigma ? std::optional(scale * *sigma) : std::nullopt;
}

std::vector<std::string> figure_row(const char* what, const evaluate::Figures& figures, double scale) {
  const evaluate::Distribution& e = figures.error;
  return {what,
          shown_number(e.rms * scale),
          shown_number(e.median * scale),
          shown_number(e.p95 * scale),
          shown_number(e.max * scale),
          figures.consistency ? shown_number(figures.consistency->normalised_square, 3) : "no sigma stated"};
}

}  // namespace

void add_trajectory(HtmlPage& page, const std::string& name, const evaluate::TrajectoryFile<EstimatePose>& file) {
  const Samples& samples = file.samples;
  page.heading("Trajectory");
  page.paragraph(name + ": " + std::to_string(samples.size()) + " poses shown of " + std::to_string(file.rows) +
                 " rows; not shown: " + std::to_string(file.refused) + " refused, " + std::to_string(file.ambiguous) +
                 " ambiguous.");
  Svg paths(3.0 * kPathSide, kPathSide + 10.0);
  draw_projection(paths, kPathMargin, samples, 0, 1, "x right, y up");
  draw_projection(paths, kPathSide + kPathMargin, samples, 0, 2, "x right, z up");
  draw_projection(paths, 2.0 * kPathSide + kPathMargin, samples, 1, 2, "y right, z up");
  page.figure(paths, "Path in the parent frame, m; green: the first pose, red: the last.");
  std::vector<VectorPoint> positions, attitudes;
  for (const auto& sample : samples) {
    positions.push_back({sample.time_s, sample.pose.t, sample.sigma_position_m});
    attitudes.push_back(
        {sample.time_s, rotation_log(sample.pose.R) * kDegPerRad, scaled(sample.sigma_rotation_rad, kDegPerRad)});
  }
  page.figure(vector_panels(positions, "position, m", BandAbout::kCurve),
              std::string("Position over time.") + kBandWords);
  page.figure(vector_panels(attitudes, "rotation vector, deg", BandAbout::kCurve),
              std::string("Attitude over time; a step of 360 deg is the same attitude.") + kBandWords);
}

void add_errors(HtmlPage& page, const evaluate::Comparison& comparison) {
  const std::vector<PoseError> errors = evaluate::errors_of(comparison.pairs.pairs, comparison.aligned.alignment);
  page.heading("Errors against the truth");
  page.paragraph(std::to_string(errors.size()) + " poses were compared. NEES: mean of (error / sigma)^2, 1 where the " +
                 "stated sigmas are right, more where they are too small.");
  page.table({"error", "RMS", "median", "95 %", "maximum", "NEES"},
             {figure_row("position, mm", comparison.figures.position, kMmPerM),
              figure_row("attitude, deg", comparison.figures.rotation, kDegPerRad)});
  std::vector<VectorPoint> positions, attitudes;
  for (const PoseError& e : errors) {
    positions.push_back({e.time_s, e.position_m * kMmPerM, scaled(e.sigma_position_m, kMmPerM)});
    attitudes.push_back({e.time_s, e.rotation_rad * kDegPerRad, scaled(e.sigma_rotation_rad, kDegPerRad)});
  }
  page.figure(vector_panels(positions, "position error, mm", BandAbout::kZero),
              std::string("Errors of the position, about zero.") + kBandWords);
  page.figure(vector_panels(attitudes, "attitude error, deg", BandAbout::kZero),
              std::string("Errors of the attitude, about zero.") + kBandWords);
}

}  // namespace pharos::tools
