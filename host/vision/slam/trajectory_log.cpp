// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/trajectory_log.hpp"

namespace pharos::slam {

TrackedPose in_left_frame(const TrackedPose& rectified, const Matrix3& R) {
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = R;
  turn.bottomRightCorner<3, 3>() = R;
  return {{R * rectified.pose.R * R.transpose(), R * rectified.pose.t},
          turn * rectified.covariance * turn.transpose(),
          rectified.rms_px};
}

void TrajectoryLog::add(const TrackedFrame& frame, KeyframeId reference,
                        const Pose<frame::Camera, frame::Camera>& T_frame_reference) {
  entries_.push_back({frame, reference, T_frame_reference});
}

std::vector<TrackedFrame> TrajectoryLog::frames(const Map& map, const Matrix3& R_left_rectified) const {
  std::vector<TrackedFrame> out;
  for (const Entry& entry : entries_) {
    out.push_back(entry.frame);
    if (!entry.frame.placed) continue;
    const CameraFromTarget pose = entry.T_frame_reference * map.pose_of(entry.reference);
    out.back().placed =
        in_left_frame({pose, entry.frame.placed->covariance, entry.frame.placed->rms_px}, R_left_rectified);
  }
  return out;
}

}  // namespace pharos::slam
