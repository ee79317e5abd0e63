// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/second_minimum.hpp"

#include <cmath>

namespace pharos::pose {
namespace {

struct Scatter {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
};

Scatter adjugate(const Scatter& m) {
  return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
          m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.yz * m.xx};
}

Scatter squared_unit_trace(const Scatter& m) {
  const double s = 1.0 / (m.xx + m.yy + m.zz);
  const Scatter a{m.xx * s, m.yy * s, m.zz * s, m.xy * s, m.xz * s, m.yz * s};
  return {a.xx * a.xx + a.xy * a.xy + a.xz * a.xz, a.xy * a.xy + a.yy * a.yy + a.yz * a.yz,
          a.xz * a.xz + a.yz * a.yz + a.zz * a.zz, a.xx * a.xy + a.xy * a.yy + a.xz * a.yz,
          a.xx * a.xz + a.xy * a.yz + a.xz * a.zz, a.xy * a.xz + a.yy * a.yz + a.yz * a.zz};
}

// Squarings of the adjugate: its eigenvalue ratio, that of the two smaller variances, goes to the 16th power.
constexpr int kSquarings = 4;

Vector3 largest_column(const Scatter& m) {
  Vector3 column;
  if (m.xx >= m.yy && m.xx >= m.zz) {
    column = Vector3(m.xx, m.xy, m.xz);
  } else if (m.yy >= m.zz) {
    column = Vector3(m.xy, m.yy, m.yz);
  } else {
    column = Vector3(m.xz, m.yz, m.zz);
  }
  return column / std::sqrt(column.squaredNorm());
}

}  // namespace

Vector3 plane_normal(const Sightings& sightings) {
  const Vector3 mean = sightings.body_centroid();
  Scatter s;
  for (int i = 0; i < sightings.count; ++i) {
    if (!sightings.seen(i, Axis::kX) && !sightings.seen(i, Axis::kY)) continue;
    const Vector3 d = sightings.body(i) - mean;
    s.xx += d.x() * d.x();
    s.yy += d.y() * d.y();
    s.zz += d.z() * d.z();
    s.xy += d.x() * d.y();
    s.xz += d.x() * d.z();
    s.yz += d.y() * d.z();
  }
  Scatter power = adjugate(s);
  for (int k = 0; k < kSquarings; ++k) power = squared_unit_trace(power);
  return largest_column(power);
}

LighthouseFromBody mirrored_in_depth(const Sightings& sightings, const LighthouseFromBody& pose) {
  const Vector3 centroid_body = sightings.body_centroid();
  const Vector3 centroid = pose * centroid_body;
  const Vector3 s = centroid / std::sqrt(centroid.squaredNorm());
  const Vector3 n_body = plane_normal(sightings);
  LighthouseFromBody mirrored;
  mirrored.R = pose.R - 2.0 * (pose.R * n_body) * n_body.transpose();
  mirrored.R -= 2.0 * s * (s.transpose() * mirrored.R);
  mirrored.t = centroid - mirrored.R * centroid_body;
  return mirrored;
}

}  // namespace pharos::pose
