// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/publish/cycle_report.hpp"
#include "host/publish/health.hpp"
#include "host/publish/message_sink.hpp"
#include "host/publish/pointing_report.hpp"
#include "host/publish/spin_report.hpp"
#include "host/publish/stereo_report.hpp"
#include "host/publish/tof_report.hpp"

namespace pharos::host {

/// What went out, by kind.
struct PublishCounters {
  std::int64_t poses = 0;
  std::int64_t bearings = 0;
  std::int64_t pointings = 0;
  std::int64_t spins = 0;
  std::int64_t status = 0;
  std::int64_t bytes = 0;
  std::int64_t failed = 0;  // messages that the sink did not take
};

/// Turns the daemon's values into LCM messages and sends them at once.
class Publisher {
 public:
  /// `sink` must outlive this. Channels are `prefix` + LIGHTHOUSE_POSE, …
  Publisher(MessageSink& sink, const std::string& prefix);

  /// pose_t. A refused cycle is told too: `valid` is false and the pose all zero, so that nobody mistakes it for one.
  bool publish_pose(const CycleReport& report);
  /// pose_t of a pose that the capture board itself solved, on a channel of its own.
  bool publish_board_pose(const CycleReport& report);
  /// pose_t of a depth camera; refused frames are told as refused cycles are.
  bool publish_pose(const TofReport& report);
  /// pose_t of a stereo rig, on the channel of its system; refused pairs are told as refused cycles are.
  bool publish_pose(const StereoReport& report);
  /// spin_t of slam's target; why there is none is told too.
  bool publish_spin(const SpinReport& report);
  /// pointing_t of a telescope; refused images and passes are told as refused cycles are.
  bool publish_pointing(const PointingReport& report);
  /// bearings_t of the same cycle.
  bool publish_bearings(const CycleReport& report);
  /// status_t.
  bool publish_health(const DaemonHealth& health);

  const PublishCounters& counters() const { return counters_; }

 private:
  template <class Message>
  bool send(const std::string& channel, const Message& message);

  MessageSink& sink_;
  std::string pose_channel_;
  std::string board_pose_channel_;
  std::string bearings_channel_;
  std::string tof_channel_;
  std::string ring2_channel_;
  std::string slam_channel_;
  std::string spin_channel_;
  std::string pointing_channel_;
  std::string status_channel_;
  std::vector<std::uint8_t> buffer_;
  std::int64_t status_sequence_ = 0;
  PublishCounters counters_;
};

}  // namespace pharos::host
