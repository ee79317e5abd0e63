// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/byte_feed.hpp"
#include "host/record/stream_reader.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/replay_timeline.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Bytes of a recorded serial stream, of one file or of several that follow each other, with their recorded arrival
/// times, so that all later stages compute the same as then. At real speed a silence of all recordings lasts at most
/// ten seconds.
class ReplayFeed : public ByteFeed {
 public:
  /// Throws InputError if the first file is not a recording. `loop` and `timeline` must outlive this.
  ReplayFeed(EventLoop& loop, ReplayTimeline& timeline, std::string name, std::vector<std::filesystem::path> files,
             ByteFeedEvents events);
  ~ReplayFeed() override;

  void attend(std::int64_t monotonic_ns) override;
  SourceState state() const override { return finished_ ? SourceState::kStale : SourceState::kOk; }
  std::string error() const override { return finished_ ? "the recording has come to its end" : ""; }
  std::string device() const override { return TargetConfig::kReplayPrefix + reader_->name(); }
  int baud() const override { return static_cast<int>(reader_->header().baud); }
  bool finished() const override { return finished_; }
  std::int64_t monotonic_now() const override { return played_ns_; }
  NamedCounts counters() const override;

 private:
  void on_timer();
  void read_next();
  bool open_next_file();
  void add_up();
  void play(const StreamChunk& chunk);
  void finish();

  EventLoop& loop_;
  ReplayTimeline& timeline_;
  ReplayTimeline::Player player_ = 0;
  std::string name_;
  std::vector<std::filesystem::path> files_;
  std::size_t file_ = 0;  // that is read
  std::optional<StreamReader> reader_;
  ByteFeedEvents events_;
  Timer timer_;
  std::optional<StreamChunk> next_;
  bool started_ = false;
  bool finished_ = false;
  std::uint64_t dropped_bytes_ = 0, lost_bytes_ = 0, bad_times_ = 0;  // of files that were read to their end
  std::int64_t files_unreadable_ = 0;
  std::int64_t played_ns_ = 0;  // recorded monotonic time of the last chunk that was played
};

}  // namespace pharos::host
