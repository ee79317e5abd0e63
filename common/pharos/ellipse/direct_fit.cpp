// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/direct_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <bit>
#include <cmath>

namespace pharos::ellipse {
namespace {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

constexpr std::size_t kMinFitPoints = 6;
// Keeps the scatter of points that lie exactly on a conic invertible.
constexpr double kRidge = 1e-11;

struct Frame {
  double u = 0.0, v = 0.0, scale = 1.0;
};

// Quotients by a count; for a power of two, as all samples of one arc or two are, by its exact inverse.
template <class Quotient>
Frame frame_of(std::span<const PointF> points, Quotient over_count) {
  Frame frame;
  for (const PointF& p : points) {
    frame.u += over_count(static_cast<double>(p.u));
    frame.v += over_count(static_cast<double>(p.v));
  }
  double squared = 0.0;
  for (const PointF& p : points) {
    const double u = static_cast<double>(p.u) - frame.u, v = static_cast<double>(p.v) - frame.v;
    squared += over_count(u * u + v * v);
  }
  frame.scale = std::sqrt(squared);
  return frame;
}

Frame frame_of(std::span<const PointF> points) {
  const double count = static_cast<double>(points.size()), inverse = 1.0 / count;
  if (std::has_single_bit(points.size())) return frame_of(points, [inverse](double sum) { return sum * inverse; });
  return frame_of(points, [count](double sum) { return sum / count; });
}

// Sums of products of (x^2, x y, y^2) and (x, y, 1); each different one once.
struct Scatter {
  double xxxx = 0.0, xxxy = 0.0, xxyy = 0.0, xyxy = 0.0, xyyy = 0.0, yyyy = 0.0;
  double xxx = 0.0, xx_y = 0.0, xy_x = 0.0, xy_y = 0.0, yy_x = 0.0, yyy = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0, x = 0.0, y = 0.0;

  void add(double px, double py) {
    const double pxx = px * px, pxy = px * py, pyy = py * py;
    xxxx += pxx * pxx;
    xxxy += pxx * pxy;
    xxyy += pxx * pyy;
    xyxy += pxy * pxy;
    xyyy += pxy * pyy;
    yyyy += pyy * pyy;
    xxx += pxx * px;
    xx_y += pxx * py;
    xy_x += pxy * px;
    xy_y += pxy * py;
    yy_x += pyy * px;
    yyy += pyy * py;
    xx += pxx;
    xy += pxy;
    yy += pyy;
    x += px;
    y += py;
  }
  Matrix3 of_quadratic() const {
    Matrix3 m;
    m << xxxx, xxxy, xxyy, xxxy, xyxy, xyyy, xxyy, xyyy, yyyy;
    return m;
  }
  Matrix3 of_both() const {
    Matrix3 m;
    m << xxx, xx_y, xx, xy_x, xy_y, xy, yy_x, yyy, yy;
    return m;
  }
  Matrix3 of_linear(std::size_t count) const {
    Matrix3 m;
    m << xx, xy, x, xy, yy, y, x, y, static_cast<double>(count);
    return m;
  }
};

// L L^T of a symmetric positive definite matrix, whose lower half is read. Eigen's own may use the heap.
class Root {
 public:
  // False where the matrix is not positive definite.
  bool take(const Matrix3& m) {
    if (!(m(0, 0) > 0.0)) return false;
    l00_ = std::sqrt(m(0, 0));
    l10_ = m(1, 0) / l00_;
    l20_ = m(2, 0) / l00_;
    const double second = m(1, 1) - l10_ * l10_;
    if (!(second > 0.0)) return false;
    l11_ = std::sqrt(second);
    l21_ = (m(2, 1) - l20_ * l10_) / l11_;
    const double third = m(2, 2) - (l20_ * l20_ + l21_ * l21_);
    if (!(third > 0.0)) return false;
    l22_ = std::sqrt(third);
    return true;
  }
  // L x = b
  Vector3 lower(const Vector3& b) const {
    const double x = b[0] / l00_, y = (b[1] - l10_ * x) / l11_;
    return {x, y, (b[2] - (l20_ * x + l21_ * y)) / l22_};
  }
  // L^T x = b
  Vector3 upper(const Vector3& b) const {
    const double z = b[2] / l22_, y = (b[1] - l21_ * z) / l11_;
    return {(b[0] - (l10_ * y + l20_ * z)) / l00_, y, z};
  }

 private:
  double l00_ = 1.0, l10_ = 0.0, l11_ = 1.0, l20_ = 0.0, l21_ = 0.0, l22_ = 1.0;
};

// A x^2 + B x y + C y^2 + D x + E y + F = 0 as an ellipse; empty where it is not one.
std::optional<Ellipse> ellipse_of(const Vector3& quadratic, const Vector3& linear) {
  const double a = quadratic[0], b = quadratic[1], c = quadratic[2], d = linear[0], e = linear[1], f = linear[2];
  const double discriminant = 4.0 * a * c - b * b;
  if (!(discriminant > 0.0)) return std::nullopt;
  Ellipse ellipse;
  ellipse.cx_px = (b * e - 2.0 * c * d) / discriminant;
  ellipse.cy_px = (b * d - 2.0 * a * e) / discriminant;
  const double at_centre = f + 0.5 * (d * ellipse.cx_px + e * ellipse.cy_px);
  // Axes: eigenvalues of [a b/2; b/2 c].
  const double mean = 0.5 * (a + c), spread = 0.5 * std::hypot(a - c, b);
  const double squared_one = -at_centre / (mean - spread), squared_two = -at_centre / (mean + spread);
  if (!(squared_one > 0.0) || !(squared_two > 0.0)) return std::nullopt;
  ellipse.a_px = std::sqrt(squared_one);
  ellipse.b_px = std::sqrt(squared_two);
  // The direction in which the quadratic part is largest is that of its larger eigenvalue.
  ellipse.theta_rad = 0.5 * std::atan2(b, a - c);
  // squared_one belongs to the smaller eigenvalue of the signed form.
  ellipse.theta_rad += std::acos(-1.0) / 2.0;
  return normalised(ellipse);
}

}  // namespace

std::optional<Ellipse> fit_direct(std::span<const PointF> points) {
  if (points.size() < kMinFitPoints) return std::nullopt;
  const Frame frame = frame_of(points);
  if (!(frame.scale > 0.0)) return std::nullopt;
  Scatter sums;
  for (const PointF& p : points) {
    sums.add((static_cast<double>(p.u) - frame.u) / frame.scale, (static_cast<double>(p.v) - frame.v) / frame.scale);
  }
  const Matrix3 s1 = sums.of_quadratic(), s2 = sums.of_both(), s3 = sums.of_linear(points.size());
  const Eigen::LDLT<Matrix3> linear_scatter(s3);
  if (linear_scatter.vectorD().minCoeff() <= 1e-9 * s3.trace()) return std::nullopt;
  // Column by column: Eigen solves for a matrix by a kernel that keeps the caches' sizes in a static.
  Matrix3 eliminate;
  for (int k = 0; k < 3; ++k) eliminate.col(k) = -linear_scatter.solve(s2.row(k).transpose());
  Matrix3 scatter = s1 + s2 * eliminate;
  scatter.diagonal().array() += kRidge * s1.trace();
  // Largest mu of C q = mu S q; C has one positive eigenvalue, and S is positive: it is the ellipse's.
  Root root;
  if (!root.take(scatter)) return std::nullopt;
  Matrix3 constraint;
  constraint << 0.0, 0.0, 2.0, 0.0, -1.0, 0.0, 2.0, 0.0, 0.0;
  Matrix3 half, reduced;
  for (int k = 0; k < 3; ++k) half.col(k) = root.lower(constraint.col(k));
  for (int k = 0; k < 3; ++k) reduced.col(k) = root.lower(half.row(k).transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(0.5 * (reduced + reduced.transpose()));
  if (eigen.info() != Eigen::Success) return std::nullopt;
  Vector3 quadratic = root.upper(eigen.eigenvectors().col(2));
  if (quadratic[0] + quadratic[2] < 0.0) quadratic = -quadratic;
  std::optional<Ellipse> ellipse = ellipse_of(quadratic, eliminate * quadratic);
  if (!ellipse) return std::nullopt;
  ellipse->cx_px = frame.u + frame.scale * ellipse->cx_px;
  ellipse->cy_px = frame.v + frame.scale * ellipse->cy_px;
  ellipse->a_px *= frame.scale;
  ellipse->b_px *= frame.scale;
  if (!std::isfinite(ellipse->a_px) || !std::isfinite(ellipse->cx_px) || !std::isfinite(ellipse->cy_px))
    return std::nullopt;
  return ellipse;
}

}  // namespace pharos::ellipse
