// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/received_pose.hpp"

#include <Eigen/Geometry>

#include "pharos/pose_t.hpp"

namespace pharos::tools {

host::PoseGrade grade_of(const ReceivedPose& pose) {
  if (!pose.has_turn && !pose.source.starts_with("ring2/")) return host::PoseGrade::kNoTurn;
  return pose.status == "ambiguous" ? host::PoseGrade::kAmbiguous : host::PoseGrade::kGood;
}

ReceivedPose received_pose(const std::string& channel, const pose_t& message, std::int64_t utc_ns) {
  ReceivedPose pose;
  pose.utime_us = message.utime;
  pose.sequence = message.sequence;
  pose.channel = channel;
  pose.source = message.source;
  pose.target = message.target;
  pose.station_id = message.station_or_camera;
  pose.station = static_cast<std::uint8_t>(message.station);
  pose.status = message.status;
  // Slam's target frame equals the camera's at the start, so its Z axis does not point to the camera.
  pose.of_camera = message.child_frame == "target" && !pose.source.starts_with("slam/");
  pose.flags = message.flags;
  pose.has_turn = pose.flags.find("no_connector") == std::string::npos;
  pose.sigma_rot_rad = message.sigma_rot_rad;
  pose.sigma_pos_m = message.sigma_pos_m;
  pose.covariance = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.covariance);
  pose.age_s = static_cast<double>(utc_ns) * 1e-9 - static_cast<double>(message.utime) * 1e-6;
  if (message.valid == 0) return pose;
  const Quaternion q(message.orientation_wxyz[0], message.orientation_wxyz[1], message.orientation_wxyz[2],
                     message.orientation_wxyz[3]);
  pose.pose = LighthouseFromBody{q.normalized().toRotationMatrix(),
                                 Vector3(message.position_m[0], message.position_m[1], message.position_m[2])};
  return pose;
}

}  // namespace pharos::tools
