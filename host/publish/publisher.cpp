// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publisher.hpp"

#include "host/publish/messages.hpp"

namespace pharos::host {

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
  const bool sent = send(pose_channel_, pose_message(report));
  counters_.poses += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_board_pose(const CycleReport& report) {
  const bool sent = send(board_pose_channel_, pose_message(report));
  counters_.poses += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_pose(const TofReport& report) {
  const bool sent = send(tof_channel_, pose_message(report));
  counters_.poses += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_pose(const StereoReport& report) {
  const bool sent = send(report.of_slam() ? slam_channel_ : ring2_channel_, pose_message(report));
  counters_.poses += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_spin(const SpinReport& report) {
  const bool sent = send(spin_channel_, spin_message(report));
  counters_.spins += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_pointing(const LineReport& report) {
  const bool sent = send(pointing_channel_, pointing_message(report));
  counters_.pointings += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_bearings(const CycleReport& report) {
  const bool sent = send(bearings_channel_, bearings_message(report));
  counters_.bearings += sent ? 1 : 0;
  return sent;
}

bool Publisher::publish_health(const DaemonHealth& health) {
  const bool sent = send(status_channel_, status_message(health, status_sequence_++));
  counters_.status += sent ? 1 : 0;
  return sent;
}

}  // namespace pharos::host
