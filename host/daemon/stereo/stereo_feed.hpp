// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/source_state_log.hpp"
#include "host/daemon/stereo/pair_source.hpp"
#include "host/daemon/stereo/pair_worker.hpp"
#include "host/daemon/stereo/stereo_pipeline.hpp"
#include "host/runtime/event_loop.hpp"

namespace pharos::host {

/// One rig of the configuration in the loop: its pairs go to a worker for each system, what comes back to that system's
/// line, troubles to the log.
class StereoFeed {
 public:
  /// `loop` and `publisher` must outlive this. `fastest`: recorded pairs without waiting between them. Throws
  /// InputError where recorded pairs, rig or vocabulary are no good after all.
  StereoFeed(EventLoop& loop, const StereoConfig& config, const PublishConfig& publish, Publisher& publisher,
             bool fastest, std::function<void()> finished);
  ~StereoFeed();

  /// Called several times a second: tells of what changed.
  void attend(std::int64_t monotonic_ns);
  /// Of every system.
  std::vector<SourceHealth> health(std::int64_t monotonic_ns);
  /// A recording whose last pair was answered.
  bool finished() const { return finish_reported_; }
  const std::string& name() const { return name_; }
  std::string clock_notice(std::int64_t monotonic_ns) const { return source_->clock_notice(monotonic_ns); }

 private:
  struct System {
    StereoPipeline line;
    PairWorker worker;
  };

  void add_system(const StereoConfig& config, const PublishConfig& publish, const char* word, Publisher& publisher,
                  std::unique_ptr<PairEstimator> estimator);
  void on_readable();
  void on_results(System& system);
  void release(StereoPairPtr pair);
  void report_when_finished();

  EventLoop& loop_;
  std::string name_;
  SourceStateLog state_log_;
  std::unique_ptr<PairSource> source_;
  std::vector<std::unique_ptr<System>> systems_;
  std::function<void()> finished_;
  bool finish_reported_ = false;
};

}  // namespace pharos::host
