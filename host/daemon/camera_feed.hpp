// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/config/daemon_config.hpp"
#include "host/daemon/event_loop.hpp"
#include "host/daemon/source_news.hpp"
#include "host/daemon/tof_line.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// One camera of the configuration in the loop: its frames go to its line as they come, its troubles to the log.
class CameraFeed {
 public:
  /// `loop` and `publisher` must outlive this. `fastest`: recorded frames without waiting between them.
  CameraFeed(EventLoop& loop, const CameraConfig& config, const PublishConfig& publish, Publisher& publisher,
             bool fastest, std::function<void()> finished);
  ~CameraFeed();

  /// Called several times a second: tells of what changed.
  void attend(std::int64_t monotonic_ns);
  SourceHealth health(std::int64_t monotonic_ns) {
    return line_.health(source_->device(), source_->status(), monotonic_ns);
  }
  bool finished() const { return finished_told_; }
  /// Recorded frames end; a camera does not.
  bool is_recorded() const { return recorded_; }
  const std::string& name() const { return name_; }
  std::string clock_notice(std::int64_t monotonic_ns) const { return line_.clock_notice(monotonic_ns); }

 private:
  void on_readable();

  EventLoop& loop_;
  std::string name_;
  bool recorded_;
  SourceNews news_;
  std::unique_ptr<FrameSource> source_;
  TofEstimator estimator_;
  TofLine line_;
  std::function<void()> finished_;
  bool finished_told_ = false;
};

}  // namespace pharos::host
