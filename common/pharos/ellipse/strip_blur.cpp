// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/strip_blur.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/image_view.hpp"
#include "pharos/ellipse/contour_places.hpp"
#include "pharos/ellipse/direct_fit.hpp"
#include "pharos/ellipse/refine_fit.hpp"

namespace pharos::ellipse {
namespace {

constexpr int kFlankPlaces = 24;
constexpr double kBeyond_px = 2.0;
// As kFlankVariance_px2, but of slopes as they are taken here: the filter, the pixel, the lens, interpolation between
// pixels, and a difference over 1 px.
constexpr double kSlopeVariance_px2 = 1.0 + 1.0 / 12.0 + 0.7 * 0.7 + 1.0 / 6.0 + 1.0 / 12.0;
constexpr double kMinVariance_px2 = 1.0;
constexpr int kHalfWidthSteps = 8;
constexpr int kSecantSteps = 4;
// Between the first two variances of the search.
constexpr double kFirstStep_px2 = 0.3;
// The fall's logarithm changes by a quarter for 1 px^2 of variance. Half of kBlurSpread_px2 is well within what the
// covariance holds anyway.
constexpr double kFallWithinSpread = 0.25 * 0.5 * kBlurSpread_px2;
constexpr double kFallTolerance = 0.005;
constexpr double kHalfWidthTolerance_px = 1e-3;

// Sums over a quarter of both contours about either end of an axis.
struct Flank {
  double at_edge = 0.0, beyond = 0.0;  // slopes away from the strip
  double seen_px = 0.0;                // sum of half of what is seen between the edges
  int places = 0;
};

// The slope so far beyond the edge over the slope there, of a strip whose edges are seen 2 `seen_px` apart.
double fall_beyond(double seen_px, double variance) {
  const double x = seen_px + kBeyond_px, per = half_width_of_strip(seen_px, variance) / variance;
  const double sines = per * seen_px > 1e-3 ? std::sinh(x * per) / std::sinh(seen_px * per) : x / seen_px;
  return sines * std::exp(0.5 * (seen_px * seen_px - x * x) / variance);
}

// The variance at which it falls so. No blur shows edges nearer than two of its sigmas.
double variance_of(double seen_px, double fall) {
  const double highest = std::max(kMinVariance_px2, seen_px * seen_px);
  double before = std::min(kSlopeVariance_px2, highest), here = std::max(kMinVariance_px2, before - kFirstStep_px2);
  double of_before = std::log(fall_beyond(seen_px, before) / fall);
  if (std::abs(of_before) < kFallWithinSpread) return kSlopeVariance_px2;
  for (int k = 0; k < kSecantSteps && here != before; ++k) {
    const double of_here = std::log(fall_beyond(seen_px, here) / fall);
    if (of_here == of_before || std::abs(of_here) < kFallTolerance) break;
    const double next = std::clamp(here - of_here * (here - before) / (of_here - of_before), kMinVariance_px2, highest);
    before = here;
    of_before = of_here;
    here = next;
  }
  return here;
}

double error_of(const Flank& flank) {
  if (flank.places == 0 || !(flank.at_edge > 0.0) || !(flank.beyond > 0.0)) return 0.0;
  const double seen_px = flank.seen_px / flank.places;
  const double excess = variance_of(seen_px, flank.beyond / flank.at_edge) - kSlopeVariance_px2;
  return half_width_of_strip(seen_px, kFlankVariance_px2) - half_width_of_strip(seen_px, kFlankVariance_px2 + excess);
}

class Flanks {
 public:
  explicit Flanks(const EllipseWorkspace& w) : smoothed_(w.planes.data(), w.width_px, w.height_px) {}

  // `away` from the strip: 1 outwards, -1 inwards; `rise`: 1 where the strip is the brighter side, else -1.
  void add(const Ellipse& contour, double away, double rise) {
    ContourPlaces places(contour, kFlankPlaces);
    for (int k = 0; k < kFlankPlaces; ++k) {
      const ContourPlaces::Place place = places.next();
      const double u = away * place.normal_u, v = away * place.normal_v;
      const auto slope = [&](double px) {
        return rise * (grey(place.point, u, v, px - 0.5) - grey(place.point, u, v, px + 0.5));
      };
      Flank& flank = flanks_[quarter_of(k)];
      flank.at_edge += slope(0.0);
      flank.beyond += slope(kBeyond_px);
    }
  }
  // What is seen between the edges.
  void measure(const Ellipse& contour, const Ellipse& other) {
    const EllipseDistance distance(other);
    ContourPlaces places(contour, kFlankPlaces);
    for (int k = 0; k < kFlankPlaces; ++k) {
      Flank& flank = flanks_[quarter_of(k)];
      flank.seen_px += 0.5 * std::abs(distance.far_px(places.next().point));
      ++flank.places;
    }
  }
  std::array<double, 2> errors_px() const { return {error_of(flanks_[0]), error_of(flanks_[1])}; }

 private:
  // Places are at equal steps from an end of the major axis.
  static std::size_t quarter_of(int place) {
    constexpr int kEighth = kFlankPlaces / 8;
    const int from_end = place % (kFlankPlaces / 2);
    return from_end > kEighth && from_end < 3 * kEighth ? 1 : 0;
  }
  double grey(const PointPx& p, double u, double v, double px) const {
    const double x = std::clamp(p.u + px * u, 0.0, smoothed_.width_px - 1.001);
    const double y = std::clamp(p.v + px * v, 0.0, smoothed_.height_px - 1.001);
    const auto column = static_cast<std::int32_t>(x), row = static_cast<std::int32_t>(y);
    const double a = x - column, b = y - row;
    const std::uint16_t *above = smoothed_.row(row) + column, *below = smoothed_.row(row + 1) + column;
    return (1.0 - b) * ((1.0 - a) * above[0] + a * above[1]) + b * ((1.0 - a) * below[0] + a * below[1]);
  }

  ImageView<const std::uint16_t> smoothed_;
  std::array<Flank, 2> flanks_;
};

}  // namespace

double half_width_of_strip(double seen_px, double variance_px2) {
  // h = x tanh(x h / s^2) (strip_of), by Newton's method from above, where it converges from one side.
  const double x = seen_px;
  if (x * x <= variance_px2) return 0.0;
  double half = x;
  for (int k = 0; k < kHalfWidthSteps; ++k) {
    const double bend = std::tanh(x * half / variance_px2);
    const double slope = 1.0 - x * x * (1.0 - bend * bend) / variance_px2;
    if (!(slope > 1e-3)) break;
    const double step = (half - x * bend) / slope;
    half -= step;
    if (step < kHalfWidthTolerance_px) break;
  }
  return std::clamp(half, 0.0, x);
}

std::array<double, 2> strip_errors(const DetectedEllipse& outer, const DetectedEllipse& inner,
                                   const EllipseWorkspace& workspace) {
  if (workspace.width_px == 0) return {};
  const double rise = outer.bright_inside ? 1.0 : -1.0;
  Flanks flanks(workspace);
  flanks.measure(outer.ellipse, inner.ellipse);
  flanks.add(outer.ellipse, 1.0, rise);
  flanks.add(inner.ellipse, -1.0, rise);
  return flanks.errors_px();
}

}  // namespace pharos::ellipse
