// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"

namespace pharos::pose {

/// Plane of best fit through points, from their sums: two passes, centroid first.
class PlaneFit {
 public:
  explicit PlaneFit(const Vector3& centroid) : centroid_(centroid) {}
  void add(const Vector3& point);

  const Vector3& centroid() const { return centroid_; }
  /// Unit normal: the direction of minimum variance. Any direction across the line where the points are collinear.
  Vector3 normal() const;
  /// Root mean square distance of the points from the plane through the centroid with this normal, m.
  double thickness_m(const Vector3& normal) const;

 private:
  Vector3 centroid_;
  double xx_ = 0.0, yy_ = 0.0, zz_ = 0.0, xy_ = 0.0, xz_ = 0.0, yz_ = 0.0;
  int count_ = 0;
};

}  // namespace pharos::pose
