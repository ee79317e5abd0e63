// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/byte_feed.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/replay_speed.hpp"
#include "host/record/stream_reader.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Bytes of a recorded serial stream with their recorded arrival times, so that all later stages compute the same as
/// then. At real speed a silence lasts at most ten seconds.
class ReplayFeed : public ByteFeed {
 public:
  /// Throws InputError if the file is not a recording. `loop` and `clock` must outlive this.
  ReplayFeed(EventLoop& loop, const Clock& clock, std::string name, const std::string& file, ReplaySpeed speed,
             ByteFeedEvents events);
  ~ReplayFeed() override;

  void attend(std::int64_t monotonic_ns) override;
  SourceState state() const override { return finished_ ? SourceState::kStale : SourceState::kOk; }
  std::string error() const override { return finished_ ? "the recording has come to its end" : ""; }
  std::string device() const override { return TargetConfig::kReplayPrefix + reader_.name(); }
  int baud() const override { return static_cast<int>(reader_.header().baud); }
  bool finished() const override { return finished_; }
  std::int64_t monotonic_now() const override { return played_ns_; }
  NamedCounts counters() const override;

 private:
  void on_timer();
  void read_next();
  std::int64_t wait_for_next();
  void play(const StreamChunk& chunk);
  void finish();

  EventLoop& loop_;
  const Clock& clock_;
  std::string name_;
  RateLimitedLog log_;
  StreamReader reader_;
  ReplaySpeed speed_;
  ByteFeedEvents events_;
  Timer timer_;
  std::optional<StreamChunk> next_;
  bool started_ = false;
  bool finished_ = false;
  std::int64_t silences_cut_ = 0;
  std::int64_t shift_ns_ = 0;   // from recorded to this computer's monotonic time
  std::int64_t played_ns_ = 0;  // recorded monotonic time of the last chunk that was played
};

}  // namespace pharos::host
