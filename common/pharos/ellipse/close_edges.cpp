// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/close_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pharos/ellipse/contour_places.hpp"
#include "pharos/ellipse/direct_fit.hpp"
#include "pharos/ellipse/refine_fit.hpp"
#include "pharos/ellipse/strip_blur.hpp"

namespace pharos::ellipse {
namespace {

constexpr int kCloseEdgePlaces = 24;
// Edges farther apart than this move by less than 0.02 px: 2 h exp(-2 h^2 / s^2).
constexpr double kMaxStrip_px = 4.8;
// Below the first a strip's width is noise; what is seen never is narrower than two sigmas.
constexpr double kMinSeenStrip = 1.03;
// Of the two steps' ratio: more is no ring's.
constexpr double kMaxStepRatio = 2.0;
constexpr int kNewtonSteps = 6;
constexpr double kConverged_px = 1e-4;

// Whether `inner` lies in `outer`, their contours within reach of each other somewhere and never crossing.
bool are_close(const Ellipse& outer, const Ellipse& inner) {
  if (outer.a_px <= inner.a_px || outer.b_px <= inner.b_px || outer.b_px - inner.b_px > kMaxStrip_px) return false;
  if (std::abs(outer.cx_px - inner.cx_px) > kMaxStrip_px || std::abs(outer.cy_px - inner.cy_px) > kMaxStrip_px)
    return false;
  const EllipseDistance distance(inner);
  ContourPlaces places(outer, kCloseEdgePlaces);
  double minimum = kMaxStrip_px;
  for (int k = 0; k < kCloseEdgePlaces; ++k) minimum = std::min(minimum, distance.far_px(places.next().point));
  return minimum > 0.0 && minimum < kMaxStrip_px;
}

// The contour moved at every place by what the edge at the gap there was pushed, times `part`; outwards where negative.
std::optional<Ellipse> pushed_back(const Ellipse& contour, const Ellipse& other, bool is_outer, double part,
                                   StripWidth& mean) {
  const EllipseDistance distance(other);
  std::array<PointF, kCloseEdgePlaces> points;
  mean = {0.0, 0.0, 0.0};
  ContourPlaces places(contour, kCloseEdgePlaces);
  for (PointF& point : points) {
    const ContourPlaces::Place place = places.next();
    const double seen = 0.5 * std::abs(distance.far_px(place.point));
    const StripWidth strip = strip_of(seen);
    mean.slope += strip.slope / kCloseEdgePlaces;
    mean.by_blur += strip.by_blur / kCloseEdgePlaces;
    const double push = (is_outer ? 1.0 : -1.0) * part * std::max(0.0, seen - strip.half_px);
    point = {static_cast<float>(place.point.u - push * place.normal_u),
             static_cast<float>(place.point.v - push * place.normal_v)};
  }
  return fit_direct(points);
}

void separate(DetectedEllipse& outer, DetectedEllipse& inner, const EllipseWorkspace& workspace) {
  // The stronger step pushes the weaker one's edge farther.
  const double ratio = std::clamp(static_cast<double>(inner.gradient) / static_cast<double>(outer.gradient),
                                  1.0 / kMaxStepRatio, kMaxStepRatio);
  StripWidth strip;
  const std::optional<Ellipse> outside = pushed_back(outer.ellipse, inner.ellipse, true, ratio, strip);
  const std::optional<Ellipse> inside = pushed_back(inner.ellipse, outer.ellipse, false, 1.0 / ratio, strip);
  if (!outside || !inside || !(inside->b_px > 0.0)) return;
  const auto [at_a_px, at_b_px] = strip_errors(outer, inner, workspace);
  outer.ellipse = *outside;
  inner.ellipse = *inside;
  // Both are the strip's middle, half of the sum, and its width, half of the difference times the slope.
  Matrix5 both = 0.25 * (1.0 + strip.slope * strip.slope) * (outer.covariance + inner.covariance);
  // Nobody tells the lens: a wider blur widens what is seen, at both axes alike.
  const double by_lens = kBlurSpread_px2 * strip.by_blur;
  both.block<2, 2>(2, 2).array() += by_lens * by_lens;
  for (DetectedEllipse* one : {&outer, &inner}) {
    const double theta = one->covariance(4, 4);
    one->covariance = both;
    // But the picture does, from some difference on.
    const double part = one == &outer ? ratio : 1.0 / ratio;
    one->covariance(2, 2) += part * part * at_a_px * at_a_px;
    one->covariance(3, 3) += part * part * at_b_px * at_b_px;
    if (both(4, 4) <= theta) continue;
    one->covariance.row(4).setZero();
    one->covariance.col(4).setZero();
    one->covariance(4, 4) = theta;
  }
}

}  // namespace

StripWidth strip_of(double seen_px) {
  const double x = std::max(seen_px, kMinSeenStrip * std::sqrt(kFlankVariance_px2));
  if (2.0 * x > kMaxStrip_px) return {seen_px, 1.0, 0.0};
  double half = x, falling = 0.0, bend = 0.0;
  for (int k = 0; k < kNewtonSteps; ++k) {
    bend = std::tanh(x * half / kFlankVariance_px2);
    falling = (1.0 - bend * bend) / kFlankVariance_px2;
    const double step = (half - x * bend) / (1.0 - x * x * falling);
    half -= step;
    if (std::abs(step) < kConverged_px) break;
  }
  const double remaining = 1.0 - x * x * falling;
  return {half, (bend + x * half * falling) / remaining, -x * x * half * falling / (kFlankVariance_px2 * remaining)};
}

std::bitset<kMaxEllipses> separate_close_edges(EllipseWorkspace& workspace) {
  std::bitset<kMaxEllipses> separated;
  auto& found = workspace.found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      if (found[i].bright_inside == found[j].bright_inside) continue;
      const bool first_is_outer = found[i].ellipse.a_px > found[j].ellipse.a_px;
      DetectedEllipse &outer = first_is_outer ? found[i] : found[j], &inner = first_is_outer ? found[j] : found[i];
      if (!are_close(outer.ellipse, inner.ellipse)) continue;
      separate(outer, inner, workspace);
      separated[i] = separated[j] = true;
    }
  }
  return separated;
}

}  // namespace pharos::ellipse
