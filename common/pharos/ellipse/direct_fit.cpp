// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/direct_fit.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::ellipse {
namespace {

constexpr std::size_t kMinFitPoints = 6;
// Keeps the scatter of points that lie exactly on a conic invertible.
constexpr double kRidge = 1e-11;
// Of a symmetric part of the scatter: below it the points lie on a line.
constexpr double kMinPivot = 2e-9;

struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

// Sums of products of coordinates from the points' mean, of degree two to four; those of degree one vanish there.
struct Moments {
  double mean_u = 0.0, mean_v = 0.0, scale = 0.0;  // scale: root of the mean squared distance from the mean
  double count = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  double xxx = 0.0, xxy = 0.0, xyy = 0.0, yyy = 0.0;
  double xxxx = 0.0, xxxy = 0.0, xxyy = 0.0, xyyy = 0.0, yyyy = 0.0;

  explicit Moments(std::span<const PointF> points) : count(static_cast<double>(points.size())) {
    for (const PointF& p : points) {
      mean_u += static_cast<double>(p.u);
      mean_v += static_cast<double>(p.v);
    }
    mean_u /= count;
    mean_v /= count;
    for (const PointF& p : points) add(static_cast<double>(p.u) - mean_u, static_cast<double>(p.v) - mean_v);
    scale = std::sqrt((xx + yy) / count);
  }

  // In units of `scale`.
  void normalise() {
    const double one = 1.0 / scale, two = one * one, three = two * one, four = two * two;
    for (double* sum : {&xx, &xy, &yy}) *sum *= two;
    for (double* sum : {&xxx, &xxy, &xyy, &yyy}) *sum *= three;
    for (double* sum : {&xxxx, &xxxy, &xxyy, &xyyy, &yyyy}) *sum *= four;
  }

 private:
  void add(double x, double y) {
    const double px = x * x, pxy = x * y, py = y * y;
    xx += px;
    xy += pxy;
    yy += py;
    xxx += px * x;
    xxy += px * y;
    xyy += py * x;
    yyy += py * y;
    xxxx += px * px;
    xxxy += px * pxy;
    xxyy += px * py;
    xyyy += py * pxy;
    yyyy += py * py;
  }
};

// The linear part of a conic, (D, E, F), that fits best to a given quadratic one, (A, B, C), as a matrix.
struct Elimination {
  Vector3 d, e, f;

  static double of(const Vector3& row, const Vector3& q) { return row.x * q.x + row.y * q.y + row.z * q.z; }
  Vector3 linear(const Vector3& q) const { return {of(d, q), of(e, q), of(f, q)}; }
};

// Empty where the points lie on a line.
std::optional<Elimination> elimination_of(const Moments& m) {
  const double determinant = m.xx * m.yy - m.xy * m.xy;
  if (!(determinant > kMinPivot * m.count * std::max(m.xx, m.yy))) return std::nullopt;
  const double inverse = 1.0 / determinant, a = m.yy * inverse, b = -m.xy * inverse, c = m.xx * inverse;
  const double over_count = 1.0 / m.count;
  return Elimination{{-(a * m.xxx + b * m.xxy), -(a * m.xxy + b * m.xyy), -(a * m.xyy + b * m.yyy)},
                     {-(b * m.xxx + c * m.xxy), -(b * m.xxy + c * m.xyy), -(b * m.xyy + c * m.yyy)},
                     {-m.xx * over_count, -m.xy * over_count, -m.yy * over_count}};
}

// Of the quadratic part, once the linear one is eliminated; the lower half, row by row.
struct Scatter {
  double s00, s10, s11, s20, s21, s22;
};

Scatter scatter_of(const Moments& m, const Elimination& t) {
  const double ridge = kRidge * (m.xxxx + m.xxyy + m.yyyy);
  return {m.xxxx + m.xxx * t.d.x + m.xxy * t.e.x + m.xx * t.f.x + ridge,
          m.xxxy + m.xxy * t.d.x + m.xyy * t.e.x + m.xy * t.f.x,
          m.xxyy + m.xxy * t.d.y + m.xyy * t.e.y + m.xy * t.f.y + ridge,
          m.xxyy + m.xyy * t.d.x + m.yyy * t.e.x + m.yy * t.f.x,
          m.xyyy + m.xyy * t.d.y + m.yyy * t.e.y + m.yy * t.f.y,
          m.yyyy + m.xyy * t.d.z + m.yyy * t.e.z + m.yy * t.f.z + ridge};
}

// The only positive root of x^3 + b x^2 - c x - d with c, d > 0, by Newton's method from above.
double positive_root(double b, double c, double d) {
  constexpr int kSteps = 60;
  double x = std::max(0.0, -b) + std::sqrt(c) + d / c;
  for (int k = 0; k < kSteps; ++k) {
    const double next = x - (((x + b) * x - c) * x - d) / ((3.0 * x + 2.0 * b) * x - c);
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

// The quadratic part (A, B, C) with the least scatter for 4 A C - B^2 = 1, but for its size: C q = mu S q with the
// positive mu, of which there is one. With S = L L^T it is an eigenvector of L^-1 C L^-T, which is
// (0, 0, r; 0, -s, t; r, t, z). Empty where S is not positive definite.
std::optional<Vector3> quadratic_of_min_scatter(const Scatter& m) {
  if (!(m.s00 > 0.0)) return std::nullopt;
  const double w00 = 1.0 / std::sqrt(m.s00), l10 = m.s10 * w00, l20 = m.s20 * w00;
  const double second = m.s11 - l10 * l10;
  if (!(second > 0.0)) return std::nullopt;
  const double w11 = 1.0 / std::sqrt(second), l21 = (m.s21 - l20 * l10) * w11;
  const double third = m.s22 - (l20 * l20 + l21 * l21);
  if (!(third > 0.0)) return std::nullopt;
  const double w22 = 1.0 / std::sqrt(third);
  const double w10 = -l10 * w00 * w11, w21 = -l21 * w11 * w22, w20 = -(l20 * w00 + l21 * w10) * w22;  // of L^-1
  const double r = 2.0 * w00 * w22, s = w11 * w11, t = 2.0 * w10 * w22 - w11 * w21, z = 4.0 * w20 * w22 - w21 * w21;
  const double root = positive_root(s - z, s * z + t * t + r * r, r * r * s);
  const double x = r / root, y = t / (s + root);
  return Vector3{w00 * x + w10 * y + w20, w11 * y + w21, w22};
}

// A x^2 + B x y + C y^2 + D x + E y + F = 0 as an ellipse; empty where it is not one.
std::optional<Ellipse> ellipse_of(const Vector3& quadratic, const Vector3& linear) {
  const double a = quadratic.x, b = quadratic.y, c = quadratic.z, d = linear.x, e = linear.y, f = linear.z;
  const double discriminant = 4.0 * a * c - b * b;
  if (!(discriminant > 0.0)) return std::nullopt;
  Ellipse ellipse;
  ellipse.cx_px = (b * e - 2.0 * c * d) / discriminant;
  ellipse.cy_px = (b * d - 2.0 * a * e) / discriminant;
  const double at_centre = f + 0.5 * (d * ellipse.cx_px + e * ellipse.cy_px);
  // Axes: eigenvalues of [a b/2; b/2 c].
  const double mean = 0.5 * (a + c), spread = 0.5 * std::sqrt((a - c) * (a - c) + b * b);
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
  Moments moments(points);
  if (!(moments.scale > 0.0)) return std::nullopt;
  moments.normalise();
  const std::optional<Elimination> elimination = elimination_of(moments);
  if (!elimination) return std::nullopt;
  std::optional<Vector3> quadratic = quadratic_of_min_scatter(scatter_of(moments, *elimination));
  if (!quadratic) return std::nullopt;
  if (quadratic->x + quadratic->z < 0.0) quadratic = {-quadratic->x, -quadratic->y, -quadratic->z};
  std::optional<Ellipse> ellipse = ellipse_of(*quadratic, elimination->linear(*quadratic));
  if (!ellipse) return std::nullopt;
  ellipse->cx_px = moments.mean_u + moments.scale * ellipse->cx_px;
  ellipse->cy_px = moments.mean_v + moments.scale * ellipse->cy_px;
  ellipse->a_px *= moments.scale;
  ellipse->b_px *= moments.scale;
  if (!std::isfinite(ellipse->a_px) || !std::isfinite(ellipse->cx_px) || !std::isfinite(ellipse->cy_px))
    return std::nullopt;
  return ellipse;
}

}  // namespace pharos::ellipse
