// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/body_frame.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace pharos::sim {

Pose<frame::Body, frame::Body> body_frame_of(const Target& assumed, const Target& built) {
  const auto n = static_cast<Eigen::Index>(built.size());
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    from.col(i) = assumed[static_cast<std::size_t>(i)].position_m;
    to.col(i) = built[static_cast<std::size_t>(i)].position_m;
  }
  const Eigen::Matrix4d T = Eigen::umeyama(from, to, false);
  return {T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
}

}  // namespace pharos::sim
