// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/second_minimum.hpp"

#include <cmath>

#include "pharos/pose/plane_fit.hpp"

namespace pharos::pose {
LighthouseFromBody mirrored_in_depth(const ObservationTable& table, const LighthouseFromBody& pose) {
  const Vector3 centroid_body = table.body_centroid();
  const Vector3 centroid = pose * centroid_body;
  const Vector3 s = centroid / std::sqrt(centroid.squaredNorm());
  PlaneFit plane(centroid_body);
  for (int i = 0; i < table.count; ++i) {
    if (table.seen(i, Axis::kX) || table.seen(i, Axis::kY)) plane.add(table.body(i));
  }
  const Vector3 n_body = plane.normal();
  LighthouseFromBody mirrored;
  mirrored.R = pose.R - 2.0 * (pose.R * n_body) * n_body.transpose();
  mirrored.R -= 2.0 * s * (s.transpose() * mirrored.R);
  mirrored.t = centroid - mirrored.R * centroid_body;
  return mirrored;
}

}  // namespace pharos::pose
