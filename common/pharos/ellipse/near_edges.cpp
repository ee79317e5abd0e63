// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/near_edges.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pharos/base/image_view.hpp"
#include "pharos/ellipse/blurred_contour.hpp"
#include "pharos/ellipse/close_edges.hpp"
#include "pharos/ellipse/contour_places.hpp"
#include "pharos/ellipse/refine_fit.hpp"

namespace pharos::ellipse {
namespace {

constexpr int kPlaces = 48;
// Along the normal, 1 px apart: an edge 6 px away moves another by 0.01 px.
constexpr int kReach_px = 7;
constexpr int kSteps = 2 * kReach_px;
// At so many places, and so far from the contour, the image is first asked whether there is anything near.
constexpr int kGlances = 24;
constexpr double kGlance_px = 4.0;
constexpr int kMinDisturbed = 2;
constexpr double kMinOther = 0.12;  // of the contour's own gradient there
// Of the gradient: the weakest edge that counts, the weakest of the contour's own.
constexpr double kMinNear = 0.06;
constexpr double kMinOwn = 0.25;
constexpr double kNoiseSigmas = 5.0;
constexpr double kMaxRatio = 2.0;
// What remains of the push once it is undone (the lens, steps that differ; in strips as narrow as the blur lets be seen
// the width itself is uncertain), and of a pull, which is not.
constexpr double kLeftOfPush = 0.4;
constexpr double kLeftOfSlope = 0.3;
constexpr double kLeftOfPull = 0.8;

using Slopes = std::array<double, kSteps>;  // between samples k and k + 1, at -kReach + 0.5 + k; of the contour's sign

struct Shift {
  double push_px = 0.0;  // outwards, by edges of opposite steps
  double left_px = 0.0;  // of it, once it is undone
  double pull_px = 0.0;  // outwards, by edges of like steps
};

using Place = ContourPlaces::Place;

class Surroundings {
 public:
  Surroundings(const DetectedEllipse& found, const EllipseWorkspace& w)
      : e_(found.ellipse),
        sign_(found.bright_inside ? -1.0 : 1.0),
        gradient_(static_cast<double>(found.gradient)),
        noise_(static_cast<double>(w.noise)),
        smoothed_(w.planes.data(), w.width_px, w.height_px),
        magnitude_(w.planes.data() + smoothed_.pixels(), w.width_px, w.height_px) {}

  bool anything_near() const {
    const double limit = std::max(kMinOther * gradient_, 3.0 * noise_);
    const double inwards = std::min(kGlance_px, e_.b_px);
    int disturbed = 0;
    ContourPlaces places(e_, kGlances);
    for (int k = 0; k < kGlances && disturbed < kMinDisturbed; ++k) {
      const Place place = places.next();
      disturbed += strong(place, kGlance_px, limit) || strong(place, -inwards, limit) ? 1 : 0;
    }
    return disturbed >= kMinDisturbed;
  }
  // Nothing where the contour itself is not seen.
  std::optional<Shift> shift_at(const Place& place) const {
    const PointPx p = place.point;
    if (p.u < kBorder_px || p.v < kBorder_px || p.u > smoothed_.width_px - 1.0 - kBorder_px ||
        p.v > smoothed_.height_px - 1.0 - kBorder_px)
      return std::nullopt;
    Slopes slopes;
    double before = 0.0;
    for (int k = 0; k <= kSteps; ++k) {
      const double here = grey(p.u + (k - kReach_px) * place.normal_u, p.v + (k - kReach_px) * place.normal_v);
      if (k > 0) slopes[static_cast<std::size_t>(k - 1)] = sign_ * (here - before);
      before = here;
    }
    const double own = 0.5 * (slopes[kReach_px - 1] + slopes[kReach_px]);
    if (own < kMinOwn * gradient_ || own < 3.0 * noise_) return std::nullopt;
    Shift shift;
    add_side(slopes, 1, own, kReach_px, shift);
    add_side(slopes, -1, own, e_.b_px, shift);
    return shift;
  }

 private:
  bool strong(const Place& place, double away_px, double limit) const {
    const auto u = static_cast<std::int32_t>(place.point.u + away_px * place.normal_u + 0.5);
    const auto v = static_cast<std::int32_t>(place.point.v + away_px * place.normal_v + 0.5);
    return magnitude_.contains(u, v) && magnitude_.at(u, v) > limit;
  }
  double grey(double u, double v) const {
    u = std::clamp(u, 0.0, smoothed_.width_px - 1.001);
    v = std::clamp(v, 0.0, smoothed_.height_px - 1.001);
    const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
    const double p = u - column, q = v - row;
    const std::uint16_t *above = smoothed_.row(row) + column, *below = smoothed_.row(row + 1) + column;
    return (1.0 - q) * ((1.0 - p) * above[0] + p * above[1]) + q * ((1.0 - p) * below[0] + p * below[1]);
  }
  // The strongest edges of either step on one side, +1 outside; not beyond the contour's own middle.
  void add_side(const Slopes& slopes, int side, double own, double reach_px, Shift& shift) const {
    const auto at = [&](double s) { return slopes[static_cast<std::size_t>(s * side + kReach_px - 0.5)]; };
    double lowest = 0.0, highest = 0.0, low_px = 0.0, high_px = 0.0;
    for (double s = 2.5; s < kReach_px - 1.0 && s <= reach_px; s += 1.0) {
      const double here = at(s), before = at(s - 1.0), after = at(s + 1.0);
      const double bend = before - 2.0 * here + after;
      const double top = bend != 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
      if (here < lowest && here <= before && here <= after) lowest = here, low_px = s + top;
      if (here > highest && here >= before && here >= after) highest = here, high_px = s + top;
    }
    const double limit = std::max(kMinNear * own, kNoiseSigmas * noise_);
    if (-lowest > limit) {
      const double ratio = std::min(-lowest / own, kMaxRatio), seen = 0.5 * low_px;
      const StripWidth strip = strip_of(seen);
      const double push = -side * ratio * std::max(0.0, seen - strip.half_px);
      shift.push_px += push;
      shift.left_px += std::clamp(kLeftOfSlope * strip.slope, kLeftOfPush, 1.0) * push;
    }
    if (highest > limit) {
      const double ratio = std::min(highest / own, kMaxRatio);
      shift.pull_px += side * ratio * high_px * std::exp(-0.5 * high_px * high_px / kFlankVariance_px2);
    }
  }

  const Ellipse& e_;
  double sign_, gradient_, noise_;
  ImageView<const std::uint16_t> smoothed_, magnitude_;
};

}  // namespace

void move_from_near_edges(DetectedEllipse& found, const EllipseWorkspace& workspace) {
  if (workspace.width_px == 0) return;
  const Surroundings surroundings(found, workspace);
  if (!surroundings.anything_near()) return;
  std::array<PointF, kPlaces> points;
  std::array<Shift, kPlaces> shifts;
  std::size_t count = 0;
  ContourPlaces places(found.ellipse, kPlaces);
  for (int k = 0; k < kPlaces; ++k) {
    const Place place = places.next();
    const std::optional<Shift> shift = surroundings.shift_at(place);
    if (!shift) continue;
    points[count] = {static_cast<float>(place.point.u), static_cast<float>(place.point.v)};
    shifts[count++] = *shift;
  }
  if (count <= 5) return;
  const BlurredContour contour(found.ellipse);
  ContourDistances distances;
  contour.measure(std::span<const PointF>(points.data(), count), distances);
  Matrix5 matrix = Matrix5::Zero();
  Vector5 of_push = Vector5::Zero(), of_left = Vector5::Zero(), of_pull = Vector5::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector5 slope = contour.slope(distances, k);
    matrix += slope * slope.transpose();
    of_push += shifts[k].push_px * slope;
    of_left += shifts[k].left_px * slope;
    of_pull += shifts[k].pull_px * slope;
  }
  const Eigen::LDLT<Matrix5> solver(matrix);
  if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 1e-12 * matrix.trace()) return;
  // The distances' slopes are those of a contour that grows: the fit that sees points outside has moved by minus that.
  const Vector5 pushed = -solver.solve(of_push), left = solver.solve(of_left), pulled = solver.solve(of_pull);
  const Matrix5 axes = contour.axes_slope();
  const std::optional<Ellipse> back = moved_by(found.ellipse, contour.turned(), -pushed);
  if (back && back->b_px > 0.0) found.ellipse = *back;
  const Vector5 push_left = axes * left, pull_left = kLeftOfPull * (axes * pulled);
  found.covariance += push_left * push_left.transpose() + pull_left * pull_left.transpose();
  limit_direction(found.covariance);
}

}  // namespace pharos::ellipse
