// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "host/config/daemon_config.hpp"
#include "host/daemon/directory_watch.hpp"
#include "host/daemon/pointing_pipeline.hpp"
#include "host/daemon/pointing_worker.hpp"
#include "host/runtime/event_loop.hpp"

namespace pharos::host {

/// One telescope of the configuration in the loop: files that arrive in its directory -> line -> worker -> line.
class PointingFeed {
 public:
  /// `loop` and `publisher` must outlive this.
  PointingFeed(EventLoop& loop, const PointingConfig& config, Publisher& publisher);
  ~PointingFeed();

  /// Called several times a second: a directory that was missing, rows that came after their images, a pass that is
  /// over.
  void attend(std::int64_t monotonic_ns);
  SourceHealth health(std::int64_t monotonic_ns);

 private:
  // What tells that the track file has changed.
  struct TrackState {
    std::filesystem::file_time_type written;
    std::uintmax_t size = 0;
    bool operator==(const TrackState&) const = default;
  };

  void on_files();
  void on_results();
  void match(bool always);
  void post(PointingJob job);
  std::optional<TrackState> track_state() const;

  EventLoop& loop_;
  PointingConfig config_;
  RateLimitedLog log_;
  PointingPipeline line_;
  DirectoryWatch watch_;
  PointingWorker worker_;
  std::optional<TrackState> track_;
  std::string last_logged_;
};

}  // namespace pharos::host
