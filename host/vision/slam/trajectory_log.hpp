// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/tracked_frame.hpp"

namespace pharos::slam {

/// Every frame by its pose relative to a keyframe, so that what mends the map mends the trajectory.
class TrajectoryLog {
 public:
  void add(const TrackedFrame& frame, KeyframeId reference,
           const Pose<frame::Camera, frame::Camera>& T_frame_reference);
  /// Poses with the map as it stands; `R_left_rectified` takes them from the rectified camera's frame to the left
  /// one's.
  std::vector<TrackedFrame> frames(const Map& map, const Matrix3& R_left_rectified) const;
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    TrackedFrame frame;
    KeyframeId reference;
    Pose<frame::Camera, frame::Camera> T_frame_reference;
  };
  std::vector<Entry> entries_;
};

/// A pose between rectified frames as the left camera's own axes tell it: R T R^T, the covariance turned alike.
TrackedPose in_left_frame(const TrackedPose& rectified, const Matrix3& R_left_rectified);

}  // namespace pharos::slam
