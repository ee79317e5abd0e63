// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "host/config/daemon_config.hpp"
#include "host/daemon/directory_watch.hpp"
#include "host/daemon/event_loop.hpp"
#include "host/daemon/telescope_line.hpp"
#include "host/daemon/telescope_worker.hpp"

namespace pharos::host {

/// One telescope of the configuration in the loop: files that arrive in its directory -> line -> worker -> line.
class TelescopeFeed {
 public:
  /// `loop` and `publisher` must outlive this.
  TelescopeFeed(EventLoop& loop, const TelescopeConfig& config, Publisher& publisher);
  ~TelescopeFeed();

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
  void post(TelescopeJob job);
  std::optional<TrackState> track_state() const;

  EventLoop& loop_;
  TelescopeConfig config_;
  LimitedLog log_;
  TelescopeLine line_;
  DirectoryWatch watch_;
  TelescopeWorker worker_;
  std::optional<TrackState> track_;
  std::string told_;
};

}  // namespace pharos::host
