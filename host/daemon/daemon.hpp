// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/byte_feed.hpp"
#include "host/daemon/calibration_memory.hpp"
#include "host/daemon/pointing_feed.hpp"
#include "host/daemon/replay_feed.hpp"
#include "host/daemon/stereo/stereo_feed.hpp"
#include "host/daemon/target_pipeline.hpp"
#include "host/daemon/tof_feed.hpp"
#include "host/publish/publisher.hpp"
#include "host/record/stream_recorder.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/log_rate_limiter.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// All targets, cameras and rigs of a configuration in one poll loop: feed -> recorder and line -> publisher, status
/// beside it.
class Daemon {
 public:
  /// Throws InputError for a replay that is no recording. `sink` must outlive this. `signals` end run().
  Daemon(const DaemonConfig& config, MessageSink& sink, Signals& signals, ReplaySpeed replay_speed);
  ~Daemon();

  /// Until a signal comes, or every feed was a replay and has come to its end.
  void run();

 private:
  struct Channel;

  void add_channel(const TargetConfig& target, ReplaySpeed replay_speed);
  std::unique_ptr<ByteFeed> make_feed(const TargetConfig& target, ReplaySpeed replay_speed, Channel& channel);
  void add_camera(const TofConfig& camera, ReplaySpeed replay_speed);
  void stop_when_all_ended();
  void load_memory();
  void attend();
  void on_signal();
  void publish_health();
  NamedCounts named_counts() const;
  std::string recording_error() const;
  std::string error() const;
  void warn(const char* kind, const std::string& error, std::int64_t now_ns);

  DaemonConfig config_;
  EventLoop loop_;
  Signals& signals_;
  Timer attend_timer_;
  Timer status_timer_;
  Publisher publisher_;
  CalibrationMemory memory_;
  LogRateLimiter log_limit_;
  std::vector<std::unique_ptr<Channel>> channels_;
  std::vector<std::unique_ptr<TofFeed>> cameras_;
  std::vector<std::unique_ptr<PointingFeed>> telescopes_;
  std::vector<std::unique_ptr<StereoFeed>> stereos_;
  std::int64_t started_ns_ = 0;
  std::int64_t failures_logged_ = 0;
  std::string message_;
};

}  // namespace pharos::host
