// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/station_relative.hpp"

#include "pharos/geometry/rotation.hpp"

namespace pharos::motion {

StationRelative StationRelative::seen_from_the_other() const {
  Matrix6 by = Matrix6::Zero();
  by.topLeftCorner<3, 3>() = by.bottomRightCorner<3, 3>() = -T_0_1.R.transpose();
  by.bottomLeftCorner<3, 3>() = -T_0_1.R.transpose() * skew(T_0_1.t);
  return {T_0_1.inverse(), by.lazyProduct(Matrix6(covariance.lazyProduct(by.transpose())))};
}

}  // namespace pharos::motion
