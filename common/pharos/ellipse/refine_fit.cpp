// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/refine_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/ellipse/blurred_contour.hpp"

namespace pharos::ellipse {
namespace {

constexpr int kIterations = 10;
// A tenth of what the best fits are uncertain by.
constexpr double kConverged_px = 2e-3;
constexpr double kTukey = 4.685;  // 95 % efficiency on normal noise
constexpr double kMedianToSigma = 1.4826;
// Lower limit of an edge's sigma, even if few points agree by chance.
constexpr double kMinSigma_px = 0.02;

// The element that std::nth_element would put at `rank`. Most are told from it by a histogram, without a branch that
// depends on them.
float element_of_rank(std::span<float> values, std::size_t rank) {
  constexpr std::size_t kBins = 64;
  const float largest = *std::max_element(values.begin(), values.end());
  if (!(largest > 0.0F) || !std::isfinite(largest)) return largest;
  const float per_bin = (kBins - 1.0F) / largest;
  std::array<std::uint8_t, kMaxFitPoints> bins;
  std::array<std::uint16_t, kBins> counts{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    bins[k] = static_cast<std::uint8_t>(std::min(kBins - 1.0F, values[k] * per_bin));
    ++counts[bins[k]];
  }
  std::size_t bin = 0, below = 0;
  while (below + counts[bin] <= rank) below += counts[bin++];
  std::size_t inside = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[inside] = values[k];
    inside += bins[k] == bin ? 1U : 0U;
  }
  const auto wanted = values.begin() + static_cast<std::ptrdiff_t>(rank - below);
  std::nth_element(values.begin(), wanted, values.begin() + static_cast<std::ptrdiff_t>(inside));
  return *wanted;
}

double scatter_of(const ContourDistances::Column& distances, std::size_t count) {
  std::array<float, kMaxFitPoints> sizes;
  for (std::size_t k = 0; k < count; ++k) sizes[k] = static_cast<float>(std::abs(distances[k]));
  const float middle = element_of_rank(std::span(sizes.data(), count), count / 2);
  return std::max(kMinSigma_px, kMedianToSigma * static_cast<double>(middle));
}

// Lower triangles only.
struct Normal {
  Matrix5 matrix = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();

  void add(const Vector5& slope, double weight, double distance) {
    const Vector5 weighted = weight * slope;
    for (int column = 0; column < 5; ++column) {
      for (int row = column; row < 5; ++row) matrix(row, column) += weighted[row] * slope[column];
    }
    gradient += weighted * distance;
  }
};

// Calls take(point's number, weight) for the points that count.
template <class Take>
void for_inliers(const ContourDistances& distances, std::size_t count, double sigma, Take&& take) {
  const double per_width = 1.0 / (kTukey * sigma);
  for (std::size_t k = 0; k < count; ++k) {
    const double ratio = distances.value[k] * per_width;
    if (std::abs(ratio) >= 1.0) continue;
    take(k, (1.0 - ratio * ratio) * (1.0 - ratio * ratio));
  }
}

Normal normal_equations(const BlurredContour& contour, const ContourDistances& distances, std::size_t count,
                        double sigma) {
  Normal normal;
  for_inliers(distances, count, sigma, [&](std::size_t k, double weight) {
    normal.add(contour.slope(distances, k), weight, distances.value[k]);
  });
  return normal;
}

double rms_of(const ContourDistances& distances, std::size_t count) {
  double squares = 0.0;
  for (std::size_t k = 0; k < count; ++k) squares += distances.value[k] * distances.value[k];
  return std::sqrt(squares / static_cast<double>(count));
}

bool is_solvable(const Eigen::LDLT<Matrix5, Eigen::Lower>& solver, double trace) {
  return solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 1e-12 * trace;
}

constexpr std::size_t kOctants = 8;
std::size_t octant_of(double x, double y, double axis_ratio) {
  return (x < 0.0 ? 1U : 0U) + (y < 0.0 ? 2U : 0U) + (std::abs(x) < std::abs(y * axis_ratio) ? 4U : 0U);
}

// The points' scatter about a fit is less than their noise: five of the independent measurements are spent on it.
double freedom_of(double measurements) {
  constexpr double kMaxFactor = 3.0;
  return measurements / std::max(measurements - 5.0, measurements / kMaxFactor);
}

// From (cx, cy, m, e1, e2) to (cx, cy, a, b, theta); near the circle theta is undefined.
Matrix5 in_axes(const Matrix5& covariance, const Ellipse& e, const BlurredContour& contour) {
  const Matrix5 change = contour.axes_slope();
  Matrix5 out = change * covariance * change.transpose();
  const double of_a = 0.5 * kBlurSpread_px2 * e.a_px / (e.b_px * e.b_px);
  const double of_b = 0.5 * kBlurSpread_px2 * e.b_px / (e.a_px * e.a_px);
  out(2, 2) += of_a * of_a;
  out(3, 3) += of_b * of_b;
  out(2, 3) += of_a * of_b;
  out(3, 2) += of_a * of_b;
  limit_direction(out);
  return out;
}

}  // namespace

std::optional<RefinedFit> refine_fit(const Ellipse& start, std::span<const PointF> points, double independent) {
  if (points.size() > kMaxFitPoints) points = points.first(kMaxFitPoints);
  if (points.size() <= 5) return std::nullopt;
  RefinedFit fit{start, Matrix5::Zero(), 0.0};
  ContourDistances distances;
  for (int k = 0; k < kIterations; ++k) {
    const BlurredContour contour(fit.ellipse);
    contour.measure(points, distances);
    const double sigma = scatter_of(distances.value, points.size());
    const Normal normal = normal_equations(contour, distances, points.size(), sigma);
    const Eigen::LDLT<Matrix5, Eigen::Lower> solver(normal.matrix);
    if (!is_solvable(solver, normal.matrix.trace())) return std::nullopt;
    const Vector5 step = -solver.solve(normal.gradient);
    const std::optional<Ellipse> next = moved_by(fit.ellipse, contour.turned(), step);
    if (!next) return std::nullopt;
    const bool done = k + 1 == kIterations || step.cwiseAbs().maxCoeff() < kConverged_px;
    if (done) {
      fit.sigma_px = sigma;
      fit.rms_px = rms_of(distances, points.size());
      // Column by column: Eigen solves for a matrix by a kernel that keeps the caches' sizes in a static.
      Matrix5 inverse;
      for (int i = 0; i < 5; ++i) inverse.col(i) = solver.solve(Vector5::Unit(i));
      const double measurements = independent * static_cast<double>(points.size());
      fit.covariance = in_axes(freedom_of(measurements) * sigma * sigma / independent * inverse, fit.ellipse, contour);
    }
    fit.ellipse = *next;
    if (done) break;
  }
  if (!fit.covariance.allFinite()) return std::nullopt;
  return fit;
}

void add_jackknife(std::span<const PointF> points, RefinedFit& fit) {
  // Noise alone scatters the fits by the covariance that it says, within a half.
  constexpr double kMaxByNoise = 2.0;
  constexpr double kFactor = (kOctants - 1.0) / kOctants;
  if (points.size() > kMaxFitPoints) points = points.first(kMaxFitPoints);
  const BlurredContour contour(fit.ellipse);
  ContourDistances distances;
  contour.measure(points, distances);
  std::array<Normal, kOctants> octants;
  const double axis_ratio = fit.ellipse.a_px / fit.ellipse.b_px;
  for_inliers(distances, points.size(), fit.sigma_px, [&](std::size_t k, double weight) {
    octants[octant_of(distances.x[k], distances.y[k], axis_ratio)].add(contour.slope(distances, k), weight,
                                                                       distances.value[k]);
  });
  Normal all;
  for (const Normal& octant : octants) {
    all.matrix += octant.matrix;
    all.gradient += octant.gradient;
  }
  const Matrix5 axes = contour.axes_slope();
  Matrix5 scatter = Matrix5::Zero();
  for (const Normal& octant : octants) {
    if (octant.matrix.trace() == 0.0) continue;
    const Eigen::LDLT<Matrix5, Eigen::Lower> rest(all.matrix - octant.matrix);
    if (!is_solvable(rest, all.matrix.trace())) continue;
    const Vector5 move = axes * rest.solve(octant.gradient - all.gradient);
    scatter += kFactor * move * move.transpose();
  }
  const double ratio = scatter.topLeftCorner<4, 4>().trace() / fit.covariance.topLeftCorner<4, 4>().trace();
  if (!(ratio > kMaxByNoise)) return;
  fit.covariance += (1.0 - kMaxByNoise / ratio) * scatter;
  limit_direction(fit.covariance);
}

}  // namespace pharos::ellipse
