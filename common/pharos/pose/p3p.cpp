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

// Ratios l1 : l2 : l3 where a line meets a conic: two, or the real part of a complex pair.
struct Meeting {
  std::array<Vector3, 2> ratios;
  bool real = false;
};

Meeting meet(const Vector3& line, const Conic& conic) {
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
  if (!(discriminant > 0.0)) return {{qq * p - pq * q, Vector3::Zero()}, false};
  const double root = pq + (pq >= 0.0 ? std::sqrt(discriminant) : -std::sqrt(discriminant));
  return {{qq * p - root * q, root * p - pp * q}, true};
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

struct Triangle {
  std::array<Vector3, 3> body, ray;
  double a12, a13, a23;  // squared sides, m^2
  Matrix3 body_axes;
  Vector3 body_mean;
};

Triangle triangle_of(const RaySet& set, const Triplet& triplet) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    t.body[k] = set.body[static_cast<std::size_t>(triplet[k])];
    t.ray[k] = set.ray[static_cast<std::size_t>(triplet[k])];
  }
  t.a12 = (t.body[0] - t.body[1]).squaredNorm();
  t.a13 = (t.body[0] - t.body[2]).squaredNorm();
  t.a23 = (t.body[1] - t.body[2]).squaredNorm();
  t.body_axes = triad(t.body[0], t.body[1], t.body[2]);
  t.body_mean = (t.body[0] + t.body[1] + t.body[2]) / 3.0;
  return t;
}

void add_pose(const Triangle& t, Vector3 distances, StartPoses& poses) {
  if (distances.sum() < 0.0) distances = -distances;
  if (!(distances.x() > 0.0 && distances.y() > 0.0 && distances.z() > 0.0)) return;
  // The scale from all three sides at once, each as the chord between two points on the rays.
  const Vector3 p0 = distances.x() * t.ray[0], p1 = distances.y() * t.ray[1], p2 = distances.z() * t.ray[2];
  const double chords = (p0 - p1).squaredNorm() + (p0 - p2).squaredNorm() + (p1 - p2).squaredNorm();
  const double scale = std::sqrt((t.a12 + t.a13 + t.a23) / chords);
  LighthouseFromBody pose;
  pose.R = triad(p0, p1, p2) * t.body_axes.transpose();
  pose.t = scale * (p0 + p1 + p2) / 3.0 - pose.R * t.body_mean;
  if (pose.is_finite()) poses.push_back(pose);
}

}  // namespace

StartPoses p3p(const RaySet& set, const Triplet& triplet) {
  const Triangle t = triangle_of(set, triplet);
  const double c12 = t.ray[0].dot(t.ray[1]), c13 = t.ray[0].dot(t.ray[2]), c23 = t.ray[1].dot(t.ray[2]);
  const Conic d1{t.a23, t.a23 - t.a12, -t.a12, -t.a23 * c12, 0.0, t.a12 * c23};
  const Conic d2{t.a23, -t.a13, t.a23 - t.a13, 0.0, -t.a23 * c13, t.a13 * c23};
  const Member member = degenerate_member(d1, d2);
  std::array<Meeting, 2> meetings;
  StartPoses poses;
  const std::array<Vector3, 2> lines = lines_of(member.conic);
  for (std::size_t k = 0; k < 2; ++k) {
    meetings[k] = meet(lines[k], member.across);
    for (const Vector3& distances : meetings[k].ratios) {
      if (meetings[k].real) add_pose(t, distances, poses);
    }
  }
  if (!poses.empty()) return poses;
  for (const Meeting& meeting : meetings) add_pose(t, meeting.ratios[0], poses);
  return poses;
}

}  // namespace pharos::pose
