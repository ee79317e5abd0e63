// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "host/daemon/directory_watch.hpp"
#include "host/daemon/pointing_pipeline.hpp"
#include "host/daemon/pointing_worker.hpp"
#include "host/daemon/source.hpp"

namespace pharos::host {

/// One telescope of the configuration: files that arrive in its directory -> pipeline -> worker -> pipeline.
class PointingFeed final : public Source {
 public:
  PointingFeed(const SourceContext& context, const PointingConfig& config);
  ~PointingFeed() override;

  const std::string& name() const override { return config_.name; }
  /// Handles a directory that was missing, rows that came after their images, and the end of a pass.
  void attend() override;
  std::vector<SourceHealth> health() override;

 private:
  // State of the track file, to detect changes.
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

  const SourceContext& context_;
  PointingConfig config_;
  RateLimitedLog log_;
  PointingPipeline pipeline_;
  DirectoryWatch watch_;
  PointingWorker worker_;
  std::optional<TrackState> track_;
  std::string last_logged_;
};

/// Opens every [[telescope]].
std::size_t open_pointing_feeds(const SourceContext& context, SourceList& sources);

}  // namespace pharos::host
