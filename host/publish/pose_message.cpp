// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "host/publish/messages.hpp"
#include "host/publish/words.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kNsPerUs = 1000;

std::int32_t saturated_us(std::int64_t ns) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(ns / kNsPerUs, -kMax, kMax));
}

std::int64_t floor_us(std::int64_t ns) { return ns / kNsPerUs - (ns % kNsPerUs < 0 ? 1 : 0); }

template <class Parent, class Child>
void fill_pose(const Pose<Parent, Child>& pose, double (&position_m)[3], double (&orientation_wxyz)[4]) {
  const Quaternion q = pose.quaternion();
  for (int i = 0; i < 3; ++i) position_m[i] = pose.t[i];
  orientation_wxyz[0] = q.w();
  orientation_wxyz[1] = q.x();
  orientation_wxyz[2] = q.y();
  orientation_wxyz[3] = q.z();
}

template <class Parent, class Child>
void fill_estimate(const PoseEstimate<Parent, Child>& estimate, pose_t& message) {
  fill_pose(estimate.pose, message.position_m, message.orientation_wxyz);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) message.covariance[6 * row + column] = estimate.covariance(row, column);
  }
  message.sigma_rot_rad = estimate.sigma_rotation_rad();
  message.sigma_pos_m = estimate.sigma_position_m();
  message.iterations = estimate.iterations;
  message.adop_deg_per_rad = estimate.adop_deg_per_rad;
  message.pdop_m_per_rad = estimate.pdop_m_per_rad;
  message.has_second = estimate.second.has_value();
  if (!estimate.second) return;
  fill_pose(estimate.second->pose, message.second_position_m, message.second_orientation_wxyz);
  message.second_delta_chi2 = estimate.second->delta_chi2;
}

bearing_t bearing_message(const ReportedBearing& bearing) {
  bearing_t message{};
  message.sensor = static_cast<std::int8_t>(bearing.sensor);
  message.axis = static_cast<std::int8_t>(index_of(bearing.axis));
  message.raw_theta_rad = bearing.raw_theta_rad;
  message.ideal_theta_rad = bearing.ideal_theta_rad;
  message.width_ticks = bearing.width_ticks;
  message.offset_ns = static_cast<std::int32_t>(bearing.offset_ns);
  message.used = bearing.used ? 1 : 0;
  message.residual_rad = bearing.residual_rad;
  return message;
}

// When, where from and how much: of CycleReport and CameraReport alike.
template <class Report>
pose_t message_of(const Report& report) {
  pose_t message{};
  message.utime = floor_us(report.utc_ns);
  message.utime_sigma_us = saturated_us(report.utc_sigma_ns);
  message.latency_us = saturated_us(report.latency_ns);
  message.sequence = report.sequence;
  message.source = report.source;
  message.target = report.target;
  message.observations = report.observations;
  return message;
}

// All of a camera's message but the pose.
pose_t camera_message(const CameraReport& report, bool ambiguous) {
  pose_t message = message_of(report);
  message.station_or_camera = report.camera;
  message.parent_frame = "camera";
  message.child_frame = "target";
  const bool refused = !report.refusal.empty();
  message.status = refused ? "refused_" + report.refusal : ambiguous ? "ambiguous" : "ok";
  message.valid = refused ? 0 : 1;
  message.flags = report.flags;
  return message;
}

}  // namespace

pose_t pose_message(const CycleReport& report) {
  pose_t message = message_of(report);
  message.station_or_camera = report.station_id;
  message.station = static_cast<std::int8_t>(report.station);
  message.parent_frame = "lighthouse";
  message.child_frame = "body";
  message.status = status_word(report.pose);
  message.valid = report.pose.ok() ? 1 : 0;
  message.flags = flag_words(report);
  if (report.pose) {
    fill_estimate(*report.pose, message);
    message.residual_rms_rad = report.pose->residual_rms;
  }
  return message;
}

pose_t pose_message(const TofReport& report) {
  pose_t message = camera_message(report, report.pose.ambiguous());
  if (message.valid != 0) fill_estimate(report.pose, message);  // residuals are metres: residual_rms_rad stays 0
  return message;
}

pose_t pose_message(const StereoReport& report) {
  return std::visit(
      [&report](const auto& pose) {
        pose_t message = camera_message(report, pose.ambiguous());
        if (!report.of_slam()) message.parent_frame = "rig";
        if (message.valid == 0) return message;
        fill_estimate(pose, message);
        message.residual_rms_rad = pose.residual_rms;
        return message;
      },
      report.pose);
}

bearings_t bearings_message(const CycleReport& report) {
  bearings_t message{};
  message.utime = floor_us(report.utc_ns);
  message.sequence = report.sequence;
  message.source = report.source;
  message.station_or_camera = report.station_id;
  message.station = static_cast<std::int8_t>(report.station);
  message.target = report.target;
  message.flags = flag_words(report);
  message.calibrated = (report.flags & track::kEpochUncalibrated) == 0 ? 1 : 0;
  for (const ReportedBearing& bearing : report.bearings) message.bearings.push_back(bearing_message(bearing));
  message.count = static_cast<std::int32_t>(message.bearings.size());
  return message;
}

}  // namespace pharos::host
