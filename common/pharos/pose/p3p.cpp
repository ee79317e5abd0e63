// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/p3p.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::pose {
namespace {

// A symmetric 3x3 form; index pairs 00 11 22 01 02 12.
struct Conic {
  double a00, a11, a22, a01, a02, a12;
};

Conic combined(const Conic& d1, double g, const Conic& d2) {
  return {d1.a00 + g * d2.a00, d1.a11 + g * d2.a11, d1.a22 + g * d2.a22,
          d1.a01 + g * d2.a01, d1.a02 + g * d2.a02, d1.a12 + g * d2.a12};
}

Conic adjugate(const Conic& m) {
  return {m.a11 * m.a22 - m.a12 * m.a12, m.a00 * m.a22 - m.a02 * m.a02, m.a00 * m.a11 - m.a01 * m.a01,
          m.a02 * m.a12 - m.a01 * m.a22, m.a01 * m.a12 - m.a02 * m.a11, m.a01 * m.a02 - m.a12 * m.a00};
}

double trace_of_product(const Conic& a, const Conic& b) {
  return a.a00 * b.a00 + a.a11 * b.a11 + a.a22 * b.a22 + 2.0 * (a.a01 * b.a01 + a.a02 * b.a02 + a.a12 * b.a12);
}

// Real roots of x^3 + b x^2 + c x + d; at least one.
int cubic_roots(double b, double c, double d, std::array<double, 3>& roots) {
  const double shift = b / 3.0;
  const double p = c / 3.0 - shift * shift;  // depressed: y^3 + 3 p y + 2 q
  const double q = shift * shift * shift + 0.5 * (d - shift * c);
  const double discriminant = q * q + p * p * p;
  if (discriminant >= 0.0) {
    const double root = std::sqrt(discriminant);
    const double u = std::cbrt(q > 0.0 ? -q - root : root - q);
    roots[0] = u - (u != 0.0 ? p / u : 0.0) - shift;
    return 1;
  }
  const double radius = std::sqrt(-p);
  const double cosine = -q / (radius * radius * radius);
  const double angle = std::acos(std::fmin(1.0, std::fmax(-1.0, cosine))) / 3.0;
  const double third = 2.0943951023931953;  // 2 pi / 3
  for (int k = 0; k < 3; ++k) {
    roots[static_cast<std::size_t>(k)] = 2.0 * radius * std::cos(angle + third * k) - shift;
  }
  return 3;
}

double polished(double x, double b, double c, double d) {
  const double slope = (3.0 * x + 2.0 * b) * x + c;
  return slope != 0.0 ? x - (((x + b) * x + c) * x + d) / slope : x;
}

// The member D1 + g D2 with det = 0 that is most certainly a pair of real lines: its adjugate's trace, the product of
// the two eigenvalues that are not zero, is the most negative.
struct Member {
  Conic conic;
  Conic across;  // of D1 and D2 the one that it is less like
};

Member degenerate_member(const Conic& d1, const Conic& d2) {
  const Conic adjugate1 = adjugate(d1), adjugate2 = adjugate(d2);
  const double leading = trace_of_product(adjugate2, d2) / 3.0;
  // A symmetric triangle seen straight on: D2 is degenerate itself.
  if (leading == 0.0) return {d2, d1};
  const double b = trace_of_product(adjugate2, d1) / leading;
  const double c = trace_of_product(adjugate1, d2) / leading;
  const double d = trace_of_product(adjugate1, d1) / 3.0 / leading;
  std::array<double, 3> roots{};
  const int count = cubic_roots(b, c, d, roots);
  Member best{d2, d1};
  double best_trace = 1e300;
  for (int k = 0; k < count; ++k) {
    const double g = polished(roots[static_cast<std::size_t>(k)], b, c, d);
    const Conic member = combined(d1, g, d2);
    const Conic minors = adjugate(member);
    const double size = std::fabs(member.a00) + std::fabs(member.a11) + std::fabs(member.a22);
    const double trace = (minors.a00 + minors.a11 + minors.a22) / (size * size);
    if (trace < best_trace) {
      best_trace = trace;
      best = {member, std::fabs(g) < 1.0 ? d2 : d1};
    }
  }
  return best;
}

// The two lines of a degenerate conic C: C + [v]x has rank one when v v^T = -adj(C); its row and column through the
// largest element are the lines.
std::array<Vector3, 2> lines_of(const Conic& c) {
  const Conic m = adjugate(c);
  Vector3 v = Vector3::Zero();
  if (m.a00 <= m.a11 && m.a00 <= m.a22) {
    if (m.a00 < 0.0) v = Vector3(-m.a00, -m.a01, -m.a02) / std::sqrt(-m.a00);
  } else if (m.a11 <= m.a22) {
    if (m.a11 < 0.0) v = Vector3(-m.a01, -m.a11, -m.a12) / std::sqrt(-m.a11);
  } else if (m.a22 < 0.0) {
    v = Vector3(-m.a02, -m.a12, -m.a22) / std::sqrt(-m.a22);
  }
  Matrix3 rank_one;
  rank_one << c.a00, c.a01 - v.z(), c.a02 + v.y(), c.a01 + v.z(), c.a11, c.a12 - v.x(), c.a02 - v.y(), c.a12 + v.x(),
      c.a22;
  int row = 0, column = 0;
  rank_one.cwiseAbs().maxCoeff(&row, &column);
  return {rank_one.row(row).transpose(), rank_one.col(column)};
}

double form(const Conic& c, const Vector3& a, const Vector3& b) {
  return a.x() * (c.a00 * b.x() + c.a01 * b.y() + c.a02 * b.z()) +
         a.y() * (c.a01 * b.x() + c.a11 * b.y() + c.a12 * b.z()) +
         a.z() * (c.a02 * b.x() + c.a12 * b.y() + c.a22 * b.z());
}

// Ratios l1 : l2 : l3 where the line meets the conic; the real part of a complex pair.
int meets(const Vector3& line, const Conic& conic, std::array<Vector3, 2>& ratios) {
  // Two points that span the line, by its largest coefficient; then the quadratic in P + s Q.
  int largest = 0;
  line.cwiseAbs().maxCoeff(&largest);
  const int next = (largest + 1) % 3, last = (largest + 2) % 3;
  Vector3 p = Vector3::Zero(), q = Vector3::Zero();
  p[next] = 1.0;
  p[largest] = -line[next] / line[largest];
  q[last] = 1.0;
  q[largest] = -line[last] / line[largest];
  const double qq = form(conic, q, q), pq = form(conic, p, q), pp = form(conic, p, p);
  const double discriminant = pq * pq - qq * pp;
  if (discriminant <= 0.0) {
    ratios[0] = qq * p - pq * q;
    return 1;
  }
  const double root = pq + (pq >= 0.0 ? std::sqrt(discriminant) : -std::sqrt(discriminant));
  ratios[0] = qq * p - root * q;
  ratios[1] = root * p - pp * q;
  return 2;
}

// Right-handed orthonormal axes of a triangle: along its first side, and in its plane.
Matrix3 triad(const Vector3& a, const Vector3& b, const Vector3& c) {
  Matrix3 axes;
  const Vector3 first = b - a;
  axes.col(0) = first / std::sqrt(first.squaredNorm());
  const Vector3 normal = first.cross(c - a);
  axes.col(2) = normal / std::sqrt(normal.squaredNorm());
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

StartPoses p3p(const RaySet& set, const Triplet& triplet) {
  std::array<Vector3, 3> b, y;
  for (std::size_t k = 0; k < 3; ++k) {
    b[k] = set.body[static_cast<std::size_t>(triplet[k])];
    y[k] = set.ray[static_cast<std::size_t>(triplet[k])];
  }
  const double a12 = (b[0] - b[1]).squaredNorm(), a13 = (b[0] - b[2]).squaredNorm(), a23 = (b[1] - b[2]).squaredNorm();
  const double c12 = y[0].dot(y[1]), c13 = y[0].dot(y[2]), c23 = y[1].dot(y[2]);
  const Conic d1{a23, a23 - a12, -a12, -a23 * c12, 0.0, a12 * c23};
  const Conic d2{a23, -a13, a23 - a13, 0.0, -a23 * c13, a13 * c23};
  const Matrix3 body_axes = triad(b[0], b[1], b[2]);
  const Vector3 body_mean = (b[0] + b[1] + b[2]) / 3.0;
  StartPoses poses;
  const Member member = degenerate_member(d1, d2);
  for (const Vector3& line : lines_of(member.conic)) {
    std::array<Vector3, 2> ratios;
    const int count = meets(line, member.across, ratios);
    for (int k = 0; k < count; ++k) {
      Vector3 l = ratios[static_cast<std::size_t>(k)];
      if (l.x() + l.y() + l.z() < 0.0) l = -l;
      if (!(l.x() > 0.0 && l.y() > 0.0 && l.z() > 0.0)) continue;
      // The scale from all three sides at once, each as the chord between two points on the rays.
      const Vector3 p0 = l.x() * y[0], p1 = l.y() * y[1], p2 = l.z() * y[2];
      const double chords = (p0 - p1).squaredNorm() + (p0 - p2).squaredNorm() + (p1 - p2).squaredNorm();
      const double scale = std::sqrt((a12 + a13 + a23) / chords);
      LighthouseFromBody pose;
      pose.R = triad(p0, p1, p2) * body_axes.transpose();
      pose.t = scale * (p0 + p1 + p2) / 3.0 - pose.R * body_mean;
      if (pose.is_finite()) poses.push_back(pose);
    }
  }
  return poses;
}

}  // namespace pharos::pose
