// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose.hpp"

namespace pharos::motion {

/// T_to_from between the frames of two stations.
using StationFromStation = Pose<frame::Lighthouse, frame::Lighthouse>;

/// Where the station of slot 1 stands: T_0_1, its pose in the frame of slot 0's, and the covariance of that pose's
/// error (Pose::moved_by).
struct StationRelative {
  StationFromStation T_0_1;
  Matrix6 covariance = Matrix6::Zero();

  /// T_1_0 and the covariance of its error.
  StationRelative seen_from_the_other() const;
};

}  // namespace pharos::motion
