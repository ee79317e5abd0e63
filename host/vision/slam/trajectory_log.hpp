// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/steady_rotation.hpp"
#include "host/vision/slam/tracked_frame.hpp"

namespace pharos::slam {

/// Every frame by its pose relative to a keyframe, so that corrections of the map correct the trajectory.
class TrajectoryLog {
 public:
  /// `own`: the covariance of the frame's pose for an exactly known `reference`. A frame that is a keyframe is its own
  /// reference, and its covariance is the map's.
  void add(const TrackedFrame& frame, KeyframeId reference, const Pose<frame::Camera, frame::Camera>& T_frame_reference,
           const Matrix6& own);
  /// Poses from the present map; `R_left_rectified` converts them from the rectified camera's frame to the left one's.
  /// Where a steady rotation is given, attitudes are on it, and the square of what this moves is part of the
  /// covariance.
  std::vector<TrackedFrame> frames(const Map& map, const Matrix3& R_left_rectified,
                                   const SteadyRotation* steady = nullptr) const;
  std::size_t size() const { return entries_.size(); }

 private:
  /// Data kept of each frame of a run: poses in double, the others in small types.
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
  std::deque<Entry> entries_;  // grows without copying
};

/// Converts a pose between rectified frames to the left camera's axes: R T R^T, and its covariance.
TrackedPose in_left_frame(const TrackedPose& rectified, const Matrix3& R_left_rectified);

}  // namespace pharos::slam
