// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/trajectory_log.hpp"

#include "host/vision/slam/keyframe_covariance.hpp"

namespace pharos::slam {
namespace {

using Triangle = std::array<float, 21>;

Triangle triangle_of(const Matrix6& symmetric) {
  Triangle out;
  auto at = out.begin();
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) *at++ = static_cast<float>(symmetric(row, column));
  }
  return out;
}

Matrix6 matrix_of(const Triangle& triangle) {
  Matrix6 out;
  auto at = triangle.begin();
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) out(row, column) = out(column, row) = static_cast<double>(*at++);
  }
  return out;
}

}  // namespace

TrackedPose in_left_frame(const TrackedPose& rectified, const Matrix3& R) {
  return {
      {R * rectified.pose.R * R.transpose(), R * rectified.pose.t}, turned(R, rectified.covariance), rectified.rms_px};
}

void TrajectoryLog::add(const TrackedFrame& frame, KeyframeId reference,
                        const Pose<frame::Camera, frame::Camera>& T_frame_reference, const Matrix6& own) {
  entries_.push_back({frame.number, frame.time_s, reference, T_frame_reference, triangle_of(own),
                      frame.placed ? static_cast<float>(frame.placed->rms_px) : 0.0F, frame.features, frame.inliers,
                      frame.placed.has_value(), frame.lost, frame.keyframe, frame.relocalised});
}

std::vector<TrackedFrame> TrajectoryLog::frames(const Map& map, const Matrix3& R_left_rectified,
                                                const SteadyRotation* steady) const {
  std::vector<TrackedFrame> out;
  out.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    out.push_back({entry.number, entry.time_s, std::nullopt, entry.lost, false, entry.keyframe, entry.relocalised,
                   entry.features, entry.inliers});
    if (!entry.placed) continue;
    CameraFromTarget pose = entry.T_frame_reference * map.pose_of(entry.reference);
    Matrix6 covariance = turned(pose.R, map.covariance_of(entry.reference));
    // A keyframe has its covariance from the map, which includes its features' part.
    if (!entry.keyframe) covariance += matrix_of(entry.own);
    if (steady != nullptr) {
      const CameraFromTarget on = steady->steadied(pose, entry.time_s);
      const Vector6 off = pose_difference(on, pose);
      covariance += off * off.transpose();
      pose = on;
    }
    out.back().placed = in_left_frame({pose, covariance, static_cast<double>(entry.rms_px)}, R_left_rectified);
  }
  return out;
}

}  // namespace pharos::slam
