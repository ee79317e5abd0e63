// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/frame_delivery.hpp"
#include "host/daemon/pointing_worker.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/publish/pointing_report.hpp"
#include "host/publish/publish_gate.hpp"
#include "host/runtime/clock.hpp"
#include "host/vision/pointing/track_file.hpp"

namespace pharos::host {

/// Outcomes of a telescope's files: each image is counted once.
struct PointingCounters {
  std::int64_t files_arrived = 0;
  std::int64_t files_no_image = 0;  ///< of another kind, or hidden
  std::int64_t images_ok = 0;
  std::int64_t images_refused = 0;        ///< refused.REASON says why
  std::int64_t images_without_track = 0;  ///< dropped without a row of the track file
  std::int64_t images_dropped = 0;        ///< more arrived than can be measured
  std::int64_t passes_ok = 0;
  std::int64_t passes_refused = 0;
  std::int64_t passes_dropped = 0;  ///< as for images
  std::int64_t track_errors = 0;    ///< the track file could not be read
  std::int64_t pointings_not_finite =
      0;  ///< results of images and passes that were not finite (a defect of this program) and not sent
  std::map<std::string, std::int64_t> refused;
};

/// One telescope's images to pointings on LCM: file and row of the track -> job -> result -> gate, and passes.
/// Independent of directories and threads.
class PointingPipeline {
 public:
  /// `publisher` and `clock` must outlive this.
  PointingPipeline(const PointingConfig& config, Publisher& publisher, const Clock& clock);

  /// A file with this name is complete in the directory.
  void arrived(const std::string& name);
  /// Whether images wait for their row.
  bool is_waiting() const { return !pending_.empty(); }
  /// Jobs for the waiting images that have a row in the current track.
  std::vector<ImageJob> match(const pointing::TrackFile& track, std::int64_t monotonic_ns);
  void track_failed(const std::string& error, std::int64_t monotonic_ns);
  /// Counts a job that was dropped for newer ones.
  void dropped(const PointingJob& job);

  /// Takes the result of an image, which is published before this returns. Its report; empty if it is not fit to be
  /// sent.
  std::optional<PointingReport> done(const ImageResult& result, std::int64_t monotonic_ns);
  /// A pass that has ended: no image for pass_gap_s, or the next image is later by more than that.
  std::optional<PassJob> take_finished_pass(std::int64_t monotonic_ns);
  void done(const PassResult& result, std::int64_t monotonic_ns);

  const PointingCounters& counters() const { return counters_; }
  std::string source() const { return "line/" + config_.name; }
  SourceHealth health(std::int64_t monotonic_ns);

 private:
  PointingReport report_of(const MeasurementOutcome& outcome, double time_s) const;
  void keep_for_pass(const ImageResult& result);
  PointingReport refuse(const ImageResult& result, std::int64_t monotonic_ns);

  PointingConfig config_;
  const Clock& clock_;
  RateLimitedLog log_;
  Matrix3 R_earth_station_;
  std::deque<std::string> pending_;
  std::vector<pointing::PassImage> pass_;
  std::vector<pointing::PassImage> over_;
  PointingCounters counters_;
  PublishGate gate_;
  RateMonitor rate_;
  FrameDelivery delivery_;
  std::int64_t last_result_ns_ = -1;
  std::string last_error_;  // error of the last image
  bool remarked_ = false;
};

}  // namespace pharos::host
