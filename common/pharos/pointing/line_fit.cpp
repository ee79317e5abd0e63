// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/line_fit.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pointing {
namespace {

constexpr int kFitRounds = 6;
constexpr std::size_t kMaxLags = 24;
constexpr std::size_t kPointsPerLag = 10;
constexpr double kBartlettVariance = 4.0 / 3.0;  // of the estimate for independent errors, times points over lags
// Mean absolute deviation to standard deviation, of a normal distribution.
constexpr double kSigmaPerMeanDeviation = 1.2533141373155003;
constexpr double kMinInflation = 0.5;

struct Straight {
  Vector2 centre = Vector2::Zero();
  Vector2 along = Vector2::UnitX();
  double weight = 0.0;  // sum of the points' weights
  double spread = 0.0;  // weighted sum of squares along the line

  Vector2 across() const { return {-along.y(), along.x()}; }
  double offset(const Vector2& place) const { return across().dot(place - centre); }
};

double weight_of(const EdgePoint& point) { return 1.0 / (point.sigma_px * point.sigma_px); }

// Through the points within `limit` (in units of a point's sigma) of `before`.
template <class Used>
Straight straight_through(std::span<const EdgePoint> points, Used used) {
  Straight result;
  for (const EdgePoint& point : points) {
    if (!used(point)) continue;
    result.centre += weight_of(point) * point.place_px;
    result.weight += weight_of(point);
  }
  if (result.weight <= 0.0) return result;
  result.centre /= result.weight;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const EdgePoint& point : points) {
    if (!used(point)) continue;
    const Vector2 d = point.place_px - result.centre;
    xx += weight_of(point) * d.x() * d.x();
    yy += weight_of(point) * d.y() * d.y();
    xy += weight_of(point) * d.x() * d.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  result.along = {std::cos(angle), std::sin(angle)};
  result.spread = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  return result;
}

// Integrated correlation of the residuals along the line, lags weighted down to the longest (Bartlett): negative ones
// count too, as errors that alternate along an edge average out. A grid of pixels or of a renderer's rays makes most of
// them: the edge crosses it at a phase that repeats. Below 1 by the estimate's own sigma (that of independent errors)
// it may be chance.
template <class Used>
double variance_inflation(std::span<const EdgePoint> points, const Straight& straight, Used used) {
  const auto residual = [&](const EdgePoint& p) { return used(p) ? straight.offset(p.place_px) / p.sigma_px : 0.0; };
  double square = 0.0;
  for (const EdgePoint& point : points) square += residual(point) * residual(point);
  if (square <= 0.0) return 1.0;
  const std::size_t lags = std::min(kMaxLags, points.size() / kPointsPerLag);
  double sum = 1.0;
  for (std::size_t lag = 1; lag <= lags; ++lag) {
    double product = 0.0;
    for (std::size_t i = lag; i < points.size(); ++i) product += residual(points[i]) * residual(points[i - lag]);
    sum += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1)) * product / square;
  }
  const double chance = std::sqrt(kBartlettVariance * static_cast<double>(lags) / static_cast<double>(points.size()));
  return std::max({kMinInflation, sum, std::min(1.0, sum + chance)});
}

LineFit fit_of(const Straight& straight, double variance) {
  LineFit fit;
  const Vector2 across = straight.across();
  fit.line.coefficients << across, -across.dot(straight.centre);
  // The line rotates by d_theta about the centroid and shifts by d_offset, independently of each other.
  Vector3 by_turn, by_shift;
  by_turn << -straight.along, straight.along.dot(straight.centre);
  by_shift << 0.0, 0.0, -1.0;
  fit.line.covariance = variance / straight.spread * by_turn * by_turn.transpose() +
                        variance / straight.weight * by_shift * by_shift.transpose();
  return fit;
}

}  // namespace

const char* name_of(LineFailure failure) {
  switch (failure) {
    case LineFailure::kTooFewPoints:
      return "too_few_points";
    case LineFailure::kNotALine:
      return "not_a_line";
  }
  return "";
}

bool undo_distortion(std::span<EdgePoint> points, const PinholeCamera& camera) {
  if (std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k == 0.0; })) return true;
  for (EdgePoint& point : points) {
    const auto ray = undistort(camera, point.place_px);
    if (!ray) return false;
    point.place_px = {camera.fx_px * ray->x() + camera.cx_px, camera.fy_px * ray->y() + camera.cy_px};
  }
  return true;
}

Result<LineFit, LineFailure> fit_line(std::span<const EdgePoint> points) {
  if (points.size() < kMinEdgePoints) return LineFailure::kTooFewPoints;
  Straight straight = straight_through(points, [](const EdgePoint&) { return true; });
  double limit = 0.0, scale = 0.0;
  for (int round = 0; round < kFitRounds; ++round) {
    const Straight before = straight;
    double deviation = 0.0;
    std::size_t used = 0;
    for (const EdgePoint& point : points) {
      const double e = std::abs(before.offset(point.place_px)) / point.sigma_px;
      if (round > 0 && e > limit) continue;
      deviation += e;
      ++used;
    }
    if (used < kMinEdgePoints) return LineFailure::kNotALine;
    scale = kSigmaPerMeanDeviation * deviation / static_cast<double>(used);
    limit = std::max(kOutlierSigmas * scale, kMinSigma_px / points.front().sigma_px);
    straight = straight_through(
        points, [&](const EdgePoint& p) { return std::abs(before.offset(p.place_px)) <= limit * p.sigma_px; });
    if (straight.weight <= 0.0) return LineFailure::kNotALine;
  }
  const auto used = [&](const EdgePoint& p) { return std::abs(straight.offset(p.place_px)) <= limit * p.sigma_px; };
  double square = 0.0, square_px = 0.0, minimum = 0.0, maximum = 0.0;
  std::size_t count = 0;
  for (const EdgePoint& point : points) {
    if (!used(point)) continue;
    const double e = straight.offset(point.place_px);
    square += e * e * weight_of(point);
    square_px += e * e;
    const double x = straight.along.dot(point.place_px - straight.centre);
    minimum = std::min(minimum, x);
    maximum = std::max(maximum, x);
    ++count;
  }
  const auto n = static_cast<double>(count);
  if (count < kMinEdgePoints || n < (1.0 - kMaxLeftOut) * static_cast<double>(points.size()) ||
      !(straight.spread > 0.0)) {
    return LineFailure::kNotALine;
  }
  const double floor = kMinSigma_px * kMinSigma_px * straight.weight / n;
  const double correlated = variance_inflation(points, straight, used);
  LineFit fit = fit_of(straight, std::max(square / (n - 2.0), floor) * correlated);
  fit.rms_px = std::sqrt(square_px / n);
  fit.variance_inflation = correlated;
  fit.points = count;
  fit.begin_px = straight.centre + minimum * straight.along;
  fit.end_px = straight.centre + maximum * straight.along;
  return fit;
}

ImageLine with_end_errors(const LineFit& fit, double sigma_px) {
  const Vector2 span = fit.end_px - fit.begin_px;
  const double length = span.norm();
  const Vector2 along = span / length;
  // Offset d1 at the begin and d2 at the end: (a, b) turns towards `along` by (d2 - d1) / length, c follows.
  Eigen::Matrix<double, 3, 2> J;
  J.topRows<2>() << -along / length, along / length;
  const double begin = along.dot(fit.begin_px) / length;
  J.row(2) << 1.0 + begin, -begin;
  ImageLine line = fit.line;
  line.covariance += sigma_px * sigma_px * J * J.transpose();
  return line;
}

}  // namespace pharos::pointing
