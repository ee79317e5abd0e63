// SPDX-License-Identifier: Apache-2.0
#include "tools/plot/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos::tools {
namespace {

constexpr double kWidth = 900.0, kPanel = 210.0, kLeft = 80.0, kRight = 20.0, kTop = 45.0, kBottom = 45.0;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Never empty: a constant, or nothing, is drawn in the middle.
  void widen(double fraction) {
    if (!(low <= high)) low = high = 0.0;
    const double span = high - low;
    const double border = span > 0.0 ? fraction * span : std::max(1e-12, 0.5 * std::abs(low));
    if (span > 0.0 && fraction == 0.0) return;
    low -= border;
    high += border;
  }
};

bool finite(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

void draw_curve(Svg& svg, const Axes& axes, const Curve& curve) {
  std::vector<PlotPoint> piece;
  const auto end_piece = [&] {
    if (piece.size() > 1) svg.polyline(piece, curve.colour, 1.3);
    piece.clear();
  };
  for (const PlotPoint& p : curve.points) {
    if (!finite(p)) {
      end_piece();
    } else if (curve.dots) {
      svg.circle(axes.at(p.x, p.y), 2.2, curve.colour);
    } else {
      piece.push_back(axes.at(p.x, p.y));
    }
  }
  end_piece();
}

void draw_legend(Svg& svg, const Axes& axes, const CurvePanel& panel) {
  double right = axes.left + axes.width;
  for (auto curve = panel.curves.rbegin(); curve != panel.curves.rend(); ++curve) {
    if (curve->name.empty()) continue;
    svg.text({right, axes.top - 8.0}, curve->name, 12.0, "end");
    right -= 7.0 * static_cast<double>(curve->name.size()) + 8.0;
    svg.line({right - 18.0, axes.top - 12.0}, {right, axes.top - 12.0}, curve->colour, 3.0);
    right -= 34.0;
  }
}

}  // namespace

void write_curves(const std::string& path, const std::vector<CurvePanel>& panels, const std::string& x_label) {
  Svg svg(kWidth, kTop + static_cast<double>(panels.size()) * (kPanel + kTop + kBottom));
  Range x;
  for (const CurvePanel& panel : panels) {
    for (const Curve& curve : panel.curves) {
      for (const PlotPoint& p : curve.points) x.take(p.x);
    }
  }
  x.widen(0.0);
  double top = kTop;
  for (const CurvePanel& panel : panels) {
    Range y;
    for (const Curve& curve : panel.curves) {
      for (const PlotPoint& p : curve.points) y.take(p.y);
    }
    y.widen(0.05);
    const Axes axes{kLeft, top, kWidth - kLeft - kRight, kPanel, x.low, x.high, y.low, y.high};
    draw_axes(svg, axes, panel.title, x_label);
    for (const Curve& curve : panel.curves) draw_curve(svg, axes, curve);
    draw_legend(svg, axes, panel);
    top += kPanel + kTop + kBottom;
  }
  svg.write(path);
}

}  // namespace pharos::tools
