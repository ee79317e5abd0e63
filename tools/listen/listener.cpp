// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/listener.hpp"

#include <cstdio>
#include <utility>

#include "pharos/pose_t.hpp"
#include "pharos/status_t.hpp"
#include "tools/listen/pose_rows.hpp"
#include "tools/listen/status_rows.hpp"

namespace pharos::tools {
namespace {

// Poses without a truth yet that are kept for the end: ten minutes at 60 Hz.
constexpr std::size_t kMostNotCompared = 36'000;

template <class Message>
bool decode(Message& message, const void* data, int size) {
  return message.decode(data, 0, size) == size;
}

ReceivedPose received(const std::string& channel, const pose_t& message, std::int64_t utc_ns) {
  ReceivedPose pose;
  pose.utime_us = message.utime;
  pose.sequence = message.sequence;
  pose.channel = channel;
  pose.source = message.source;
  pose.target = message.target;
  pose.station_id = message.station_or_camera;
  pose.station = static_cast<std::uint8_t>(message.station);
  pose.status = message.status;
  pose.of_camera = message.child_frame == "target";
  pose.flags = message.flags;
  pose.sigma_rot_rad = message.sigma_rot_rad;
  pose.sigma_pos_m = message.sigma_pos_m;
  pose.age_s = static_cast<double>(utc_ns) * 1e-9 - static_cast<double>(message.utime) * 1e-6;
  if (message.valid == 0) return pose;
  const Quaternion q(message.orientation_wxyz[0], message.orientation_wxyz[1], message.orientation_wxyz[2],
                     message.orientation_wxyz[3]);
  pose.pose = LighthouseFromBody{q.normalized().toRotationMatrix(),
                                 Vector3(message.position_m[0], message.position_m[1], message.position_m[2])};
  return pose;
}

}  // namespace

Listener::Listener(ListenFormat format, std::optional<TruthFile> truth) : format_(format), truth_(std::move(truth)) {
  if (format_ != ListenFormat::kCsv && format_ != ListenFormat::kJson) return;
  const auto row_format = format_ == ListenFormat::kJson ? host::RowFormat::kJson : host::RowFormat::kCsv;
  rows_ = std::make_unique<host::RowWriter>(stdout, row_format, pose_columns());
}

void Listener::begin() {
  if (rows_) rows_->flush();
}

void Listener::take(const std::string& channel, const void* data, int size, std::int64_t utc_ns,
                    std::int64_t monotonic_ns) {
  pose_t pose;
  status_t status;
  if (decode(pose, data, size)) {
    take_pose(channel, pose, utc_ns, monotonic_ns);
  } else if (decode(status, data, size)) {
    take_status(status);
  } else {
    ++foreign_;
  }
}

void Listener::take_pose(const std::string& channel, const pose_t& message, std::int64_t utc_ns,
                         std::int64_t monotonic_ns) {
  ReceivedPose pose = received(channel, message, utc_ns);
  pose.rate_hz = summary_.add(pose, monotonic_ns);
  if (pose.pose && truth_) compare(pose);
  print(pose);
}

void Listener::compare(ReceivedPose& pose) {
  if (const auto truth = truth_->at(pose.station, pose.utime_us)) {
    pose.error = pose_error(*pose.pose, *truth);
    summary_.add_error(pose, *pose.error);
  } else if (not_compared_.size() < kMostNotCompared) {
    not_compared_.push_back(pose);
  }
}

void Listener::finish() {
  for (ReceivedPose& pose : std::exchange(not_compared_, {})) compare(pose);
}

void Listener::print(const ReceivedPose& pose) {
  if (format_ == ListenFormat::kNone) return;
  if (format_ == ListenFormat::kLines) {
    std::puts(pose_line(pose).c_str());
    std::fflush(stdout);
    return;
  }
  write_pose_row(*rows_, pose);
}

void Listener::take_status(const status_t& message) {
  ++status_messages_;
  if (format_ == ListenFormat::kNone || format_ == ListenFormat::kCsv) return;
  std::puts((format_ == ListenFormat::kJson ? status_json(message) : status_lines(message)).c_str());
  std::fflush(stdout);
}

}  // namespace pharos::tools
