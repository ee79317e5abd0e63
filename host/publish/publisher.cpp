// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publisher.hpp"

#include "host/publish/messages.hpp"

namespace pharos::host {
namespace {

bool counted(bool sent, std::int64_t& count) {
  count += sent ? 1 : 0;
  return sent;
}

}  // namespace

Publisher::Publisher(MessageSink& sink, const std::string& prefix)
    : sink_(sink),
      pose_channel_(prefix + "LIGHTHOUSE_POSE"),
      board_pose_channel_(prefix + "LIGHTHOUSE_BOARD_POSE"),
      bearings_channel_(prefix + "LIGHTHOUSE_BEARINGS"),
      tof_channel_(prefix + "TOF_POSE"),
      ring2_channel_(prefix + "RING2_POSE"),
      slam_channel_(prefix + "SLAM_POSE"),
      spin_channel_(prefix + "SLAM_SPIN"),
      pointing_channel_(prefix + "LINE_POINTING"),
      status_channel_(prefix + "STATUS") {}

template <class Message>
bool Publisher::send(const std::string& channel, const Message& message) {
  const int size = message.getEncodedSize();
  buffer_.resize(static_cast<std::size_t>(size));
  const bool sent = message.encode(buffer_.data(), 0, size) == size && sink_.send(channel, buffer_);
  if (sent) {
    counters_.bytes += size;
  } else {
    ++counters_.failed;
  }
  return sent;
}

bool Publisher::publish_pose(const CycleReport& report) {
  return counted(send(pose_channel_, pose_message(report)), counters_.poses);
}

bool Publisher::publish_board_pose(const CycleReport& report) {
  return counted(send(board_pose_channel_, pose_message(report)), counters_.poses);
}

bool Publisher::publish_pose(const TofReport& report) {
  return counted(send(tof_channel_, pose_message(report)), counters_.poses);
}

bool Publisher::publish_pose(const StereoReport& report) {
  return counted(send(report.of_slam() ? slam_channel_ : ring2_channel_, pose_message(report)), counters_.poses);
}

bool Publisher::publish_spin(const SpinReport& report) {
  return counted(send(spin_channel_, spin_message(report)), counters_.spins);
}

bool Publisher::publish_pointing(const PointingReport& report) {
  return counted(send(pointing_channel_, pointing_message(report)), counters_.pointings);
}

bool Publisher::publish_bearings(const CycleReport& report) {
  return counted(send(bearings_channel_, bearings_message(report)), counters_.bearings);
}

bool Publisher::publish_health(const DaemonHealth& health) {
  return counted(send(status_channel_, status_message(health, status_sequence_++)), counters_.status);
}

}  // namespace pharos::host
