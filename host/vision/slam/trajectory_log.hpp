// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/tracked_frame.hpp"

namespace pharos::slam {

/// Every frame by its pose relative to a keyframe, so that what mends the map mends the trajectory.
class TrajectoryLog {
 public:
  /// `own`: the covariance that the frame's features leave where `reference` stands for certain. A frame that is a
  /// keyframe is told from itself, and has it once the map holds that keyframe no more.
  void add(const TrackedFrame& frame, KeyframeId reference, const Pose<frame::Camera, frame::Camera>& T_frame_reference,
           const Matrix6& own);
  /// Poses with the map as it stands; `R_left_rectified` takes them from the rectified camera's frame to the left
  /// one's.
  std::vector<TrackedFrame> frames(const Map& map, const Matrix3& R_left_rectified) const;
  std::size_t size() const { return entries_.size(); }

 private:
  /// What a run holds of each frame: poses in full, the rest as small as it goes.
  struct Entry {
    std::int64_t number;
    double time_s;
    KeyframeId reference;
    Pose<frame::Camera, frame::Camera> T_frame_reference;
    std::array<float, 21> own;  // upper triangle, row by row
    float rms_px;
    std::int32_t features, inliers;
    bool placed, lost, keyframe, relocalised;
  };
  static_assert(sizeof(Entry) <= 224);
  std::deque<Entry> entries_;  // grows without moving
};

/// A pose between rectified frames as the left camera's own axes tell it: R T R^T, the covariance turned alike.
TrackedPose in_left_frame(const TrackedPose& rectified, const Matrix3& R_left_rectified);

}  // namespace pharos::slam
