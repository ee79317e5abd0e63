// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/fit_dot.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::calibrate {
namespace {

constexpr int kUnknowns = 10;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
// The unknowns' order: centre, shape (of the matrix whose unit level is the edge), background, contrast and its
// gradient, blur.
enum : Eigen::Index { kU, kV, kUU, kUV, kVV, kBackground, kContrast, kGradientU, kGradientV, kBlur };

constexpr int kMaxSteps = 40;
constexpr double kSmallStep_px = 1e-6;
constexpr double kMinBlur_px = 0.15;  // a pixel's own width is 0.29
constexpr double kMaxBlur_px = 50.0;

struct Sample {
  double u, v, grey;
};

std::vector<Sample> samples_of(GreyView image, const Blob& blob, double reach) {
  const Matrix2 shape = (4.0 * blob.covariance_px2).inverse();
  const double along_u = reach * 2.0 * std::sqrt(blob.covariance_px2(0, 0)) + 1.0;
  const double along_v = reach * 2.0 * std::sqrt(blob.covariance_px2(1, 1)) + 1.0;
  const auto first = [](double x) { return static_cast<std::int32_t>(std::ceil(std::max(x, 0.0))); };
  const auto last = [](double x, std::int32_t size) {
    return static_cast<std::int32_t>(std::floor(std::min(x, size - 1.0)));
  };
  std::vector<Sample> samples;
  for (std::int32_t v = first(blob.centre_px.y() - along_v); v <= last(blob.centre_px.y() + along_v, image.height_px);
       ++v) {
    for (std::int32_t u = first(blob.centre_px.x() - along_u); u <= last(blob.centre_px.x() + along_u, image.width_px);
         ++u) {
      const Vector2 d = Vector2(u, v) - blob.centre_px;
      if (d.dot(shape * d) < reach * reach) samples.push_back({double(u), double(v), double(image.at(u, v))});
    }
  }
  return samples;
}

// Grey value and its derivatives at a pixel. The distance to the edge is first order: (1 - q) / |grad q| with
// q^2 = d^T M d and grad q = M d / q.
double grey_at(const Vector& x, const Sample& sample, Vector& derivative) {
  const Vector2 d(sample.u - x[kU], sample.v - x[kV]);
  Matrix2 shape;
  shape << x[kUU], x[kUV], x[kUV], x[kVV];
  const Vector2 w = shape * d;
  const double q = std::sqrt(std::max(d.dot(w), 1e-12)), length = std::max(w.norm(), 1e-9);
  const double edge = (1.0 - q) * q / (length * x[kBlur]);  // in blurs, inside positive
  const double inside = 0.5 * std::erfc(-edge / std::numbers::sqrt2);
  const double density = std::exp(-0.5 * edge * edge) / std::sqrt(2.0 * std::numbers::pi);
  const double plateau = x[kContrast] + x[kGradientU] * d.x() + x[kGradientV] * d.y();
  const double by_edge = plateau * density;
  const double by_q = by_edge * (1.0 - 2.0 * q) / (length * x[kBlur]), by_length = -by_edge * edge / length;
  const Vector2 by_d = by_q / q * w + by_length / length * (shape * w);
  derivative[kU] = -by_d.x() - x[kGradientU] * inside;
  derivative[kV] = -by_d.y() - x[kGradientV] * inside;
  derivative[kUU] = by_q * d.x() * d.x() / (2.0 * q) + by_length * w.x() * d.x() / length;
  derivative[kUV] = by_q * d.x() * d.y() / q + by_length * (w.x() * d.y() + w.y() * d.x()) / length;
  derivative[kVV] = by_q * d.y() * d.y() / (2.0 * q) + by_length * w.y() * d.y() / length;
  derivative[kBackground] = 1.0;
  derivative[kContrast] = inside;
  derivative[kGradientU] = inside * d.x();
  derivative[kGradientV] = inside * d.y();
  derivative[kBlur] = -by_edge * edge / x[kBlur];
  return x[kBackground] + plateau * inside;
}

struct Normal {
  Matrix information = Matrix::Zero();
  Vector gradient = Vector::Zero();
  double squares = 0.0;
};

Normal normal_at(const Vector& x, const std::vector<Sample>& samples) {
  Normal normal;
  Vector derivative;
  for (const Sample& sample : samples) {
    const double residual = sample.grey - grey_at(x, sample, derivative);
    normal.information.noalias() += derivative * derivative.transpose();
    normal.gradient += derivative * residual;
    normal.squares += residual * residual;
  }
  return normal;
}

bool is_sound(const Vector& x) {
  return x.allFinite() && x[kUU] > 0.0 && x[kUU] * x[kVV] > x[kUV] * x[kUV] && x[kBlur] < kMaxBlur_px;
}

Vector start_of(const Blob& blob, const std::vector<Sample>& samples) {
  const Matrix2 shape = (4.0 * blob.covariance_px2).inverse();
  double in = 0.0, out = 0.0, count_in = 0.0, count_out = 0.0;
  for (const Sample& s : samples) {
    const Vector2 d = Vector2(s.u, s.v) - blob.centre_px;
    const bool inside = d.dot(shape * d) < 1.0;
    (inside ? in : out) += s.grey;
    (inside ? count_in : count_out) += 1.0;
  }
  Vector x = Vector::Zero();
  x[kU] = blob.centre_px.x();
  x[kV] = blob.centre_px.y();
  x[kUU] = shape(0, 0);
  x[kUV] = shape(0, 1);
  x[kVV] = shape(1, 1);
  x[kBackground] = out / std::max(count_out, 1.0);
  x[kContrast] = in / std::max(count_in, 1.0) - x[kBackground];
  x[kBlur] = 0.7;
  return x;
}

std::optional<DotFit> fit_of(const Vector& x, const Normal& normal, std::size_t samples) {
  // The largest eigenvalue of the shape, and its determinant.
  const double largest = 0.5 * (x[kUU] + x[kVV]) + std::hypot(0.5 * (x[kUU] - x[kVV]), x[kUV]);
  const double determinant = x[kUU] * x[kVV] - x[kUV] * x[kUV];
  const double variance = normal.squares / static_cast<double>(samples - kUnknowns);
  const auto covariance = positive_inverse<kUnknowns>(normal.information);
  if (!covariance) return std::nullopt;
  DotFit fit;
  fit.centre_px = x.head<2>();
  fit.sigma_px = std::sqrt(0.5 * variance * ((*covariance)(kU, kU) + (*covariance)(kV, kV)));
  fit.minor_px = 1.0 / std::sqrt(largest);
  fit.area_px2 = std::numbers::pi / std::sqrt(determinant);
  fit.blur_px = x[kBlur];
  fit.misfit = std::sqrt(variance) / std::abs(x[kContrast]);
  return fit;
}

}  // namespace

std::optional<DotFit> fit_dot(GreyView image, const Blob& blob, double reach) {
  const std::vector<Sample> samples = samples_of(image, blob, reach);
  if (samples.size() < 3 * kUnknowns) return std::nullopt;
  Vector x = start_of(blob, samples);
  if (x[kContrast] == 0.0) return std::nullopt;
  Normal normal = normal_at(x, samples);
  double damping = 1e-3;
  for (int step = 0; step < kMaxSteps; ++step) {
    Matrix damped = normal.information;
    damped.diagonal() *= 1.0 + damping;
    const auto covariance = positive_inverse<kUnknowns>(damped);
    const Vector move = covariance ? Vector(*covariance * normal.gradient) : Vector::Zero();
    Vector moved = x + move;
    moved[kBlur] = std::max(moved[kBlur], kMinBlur_px);
    const bool sound = covariance && is_sound(moved);
    const Normal next = sound ? normal_at(moved, samples) : Normal{};
    if (sound && next.squares <= normal.squares) {
      x = moved;
      normal = next;
      damping = std::max(damping * 0.1, 1e-9);
      if (move.head<2>().norm() < kSmallStep_px) break;
    } else {
      damping *= 10.0;
      if (damping > 1e6) break;
    }
  }
  const std::optional<DotFit> fit = fit_of(x, normal, samples.size());
  if (!fit) return std::nullopt;
  const bool near = (fit->centre_px - blob.centre_px).norm() < 2.0 * std::sqrt(blob.covariance_px2.trace());
  if (!near || !std::isfinite(fit->sigma_px) || fit->sigma_px <= 0.0) return std::nullopt;
  return fit;
}

}  // namespace pharos::calibrate
