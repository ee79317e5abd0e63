// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/plane_fit.hpp"

#include <cmath>

namespace pharos::pose {
namespace {

// Squarings of the adjugate: the ratio of its two largest eigenvalues, that of the two smaller variances, goes to the
// 16th power.
constexpr int kSquarings = 4;

struct Scatter {
  double xx, yy, zz, xy, xz, yz;
};

Scatter adjugate(const Scatter& m) {
  return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
          m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.yz * m.xx};
}

Scatter squared_at_unit_trace(const Scatter& m) {
  const double s = 1.0 / (m.xx + m.yy + m.zz);
  const Scatter a{m.xx * s, m.yy * s, m.zz * s, m.xy * s, m.xz * s, m.yz * s};
  return {a.xx * a.xx + a.xy * a.xy + a.xz * a.xz, a.xy * a.xy + a.yy * a.yy + a.yz * a.yz,
          a.xz * a.xz + a.yz * a.yz + a.zz * a.zz, a.xx * a.xy + a.xy * a.yy + a.xz * a.yz,
          a.xx * a.xz + a.xy * a.yz + a.xz * a.zz, a.xy * a.xz + a.yy * a.yz + a.yz * a.zz};
}

Vector3 largest_column(const Scatter& m) {
  if (m.xx >= m.yy && m.xx >= m.zz) return {m.xx, m.xy, m.xz};
  if (m.yy >= m.zz) return {m.xy, m.yy, m.yz};
  return {m.xz, m.yz, m.zz};
}

}  // namespace

void PlaneFit::add(const Vector3& point) {
  const Vector3 d = point - centroid_;
  xx_ += d.x() * d.x();
  yy_ += d.y() * d.y();
  zz_ += d.z() * d.z();
  xy_ += d.x() * d.y();
  xz_ += d.x() * d.z();
  yz_ += d.y() * d.z();
  ++count_;
}

Vector3 PlaneFit::normal() const {
  Scatter power = adjugate(Scatter{xx_, yy_, zz_, xy_, xz_, yz_});
  if (!(power.xx + power.yy + power.zz > 0.0)) return Vector3::UnitZ();
  for (int k = 0; k < kSquarings; ++k) power = squared_at_unit_trace(power);
  const Vector3 column = largest_column(power);
  return column / std::sqrt(column.squaredNorm());
}

double PlaneFit::thickness_m(const Vector3& n) const {
  const double sum = n.x() * n.x() * xx_ + n.y() * n.y() * yy_ + n.z() * n.z() * zz_ +
                     2.0 * (n.x() * n.y() * xy_ + n.x() * n.z() * xz_ + n.y() * n.z() * yz_);
  return count_ > 0 ? std::sqrt(std::fmax(0.0, sum) / count_) : 0.0;
}

}  // namespace pharos::pose
