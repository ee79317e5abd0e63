// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/config/daemon_config.hpp"
#include "host/daemon/source_state_log.hpp"
#include "host/daemon/tof_pipeline.hpp"
#include "host/device/frame_source.hpp"
#include "host/runtime/event_loop.hpp"

namespace pharos::host {

/// One camera of the configuration in the loop: its frames go to its line as they come, its troubles to the log.
class TofFeed {
 public:
  /// `loop` and `publisher` must outlive this. `fastest`: recorded frames without waiting between them.
  TofFeed(EventLoop& loop, const TofConfig& config, const PublishConfig& publish, Publisher& publisher, bool fastest,
          std::function<void()> finished);
  ~TofFeed();

  /// Called several times a second: tells of what changed.
  void attend(std::int64_t monotonic_ns);
  SourceHealth health(std::int64_t monotonic_ns) {
    return line_.health(source_->device(), source_->status(), monotonic_ns);
  }
  bool finished() const { return finish_reported_; }
  /// Recorded frames end; a camera does not.
  bool is_recorded() const { return recorded_; }
  const std::string& name() const { return name_; }
  std::string clock_notice(std::int64_t monotonic_ns) const { return line_.clock_notice(monotonic_ns); }

 private:
  void on_readable();

  EventLoop& loop_;
  std::string name_;
  bool recorded_;
  SourceStateLog state_log_;
  std::unique_ptr<FrameSource> source_;
  TofEstimator estimator_;
  TofPipeline line_;
  std::function<void()> finished_;
  bool finish_reported_ = false;
};

}  // namespace pharos::host
