// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "host/publish/messages.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

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

}  // namespace

pose_t pose_message_of(const MeasurementHeader& header) {
  pose_t message{};
  message.utime = floor_us(header.utc_ns);
  message.utime_sigma_us = saturated_us(header.utc_sigma_ns);
  message.latency_us = saturated_us(header.age_ns);
  message.sequence = header.sequence;
  message.source = header.source;
  message.station_or_camera = header.sensor;
  message.target = header.target;
  message.parent_frame = header.frames.parent;
  message.child_frame = header.frames.child;
  message.status = status_word(header);
  message.valid = header.answered() ? 1 : 0;
  message.flags = header.flags;
  message.observations = header.observations;
  return message;
}

pose_t message_of(const CycleReport& report) {
  pose_t message = pose_message_of(report);
  message.station = static_cast<std::int8_t>(report.station);
  if (!report.answered()) return message;
  fill_estimate(report.pose, message);
  message.residual_rms_rad = report.pose.residual_rms;
  return message;
}

pose_t message_of(const WorldPoseReport& report) {
  pose_t message = pose_message_of(report);
  if (!report.answered()) return message;
  fill_estimate(report.pose, message);
  message.residual_rms_rad = report.pose.residual_rms;
  return message;
}

pose_t message_of(const TofReport& report) {
  pose_t message = pose_message_of(report);
  if (report.answered()) fill_estimate(report.pose, message);  // residuals are metres: residual_rms_rad stays 0
  return message;
}

pose_t message_of(const StereoReport& report) {
  pose_t message = pose_message_of(report);
  if (!report.answered()) return message;
  std::visit(
      [&message](const auto& pose) {
        fill_estimate(pose, message);
        message.residual_rms_rad = pose.residual_rms;
      },
      report.pose);
  return message;
}

bearings_t message_of(const BearingsReport& report) {
  bearings_t message{};
  message.utime = floor_us(report.utc_ns);
  message.sequence = report.sequence;
  message.source = report.source;
  message.station_or_camera = report.sensor;
  message.station = static_cast<std::int8_t>(report.station);
  message.target = report.target;
  message.flags = report.flags;
  message.calibrated = report.calibrated ? 1 : 0;
  for (const ReportedBearing& bearing : report.bearings) message.bearings.push_back(bearing_message(bearing));
  message.count = static_cast<std::int32_t>(message.bearings.size());
  return message;
}

}  // namespace pharos::host
