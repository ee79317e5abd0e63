// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "host/config/daemon_config.hpp"
#include "host/daemon/clock_step_monitor.hpp"
#include "host/daemon/frame_clock.hpp"
#include "host/daemon/frame_delivery.hpp"
#include "host/daemon/pose_average.hpp"
#include "host/daemon/pose_jump_check.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/daemon/source_changes.hpp"
#include "host/daemon/tof_counters.hpp"
#include "host/daemon/tof_worker.hpp"
#include "host/device/frame_source.hpp"
#include "host/publish/publish_gate.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/latency_histogram.hpp"

namespace pharos::host {

/// One depth camera's frames to poses on LCM: time -> (estimator) -> mean -> gate. Independent of cameras, files and
/// threads.
class TofPipeline {
 public:
  /// `publisher` and `clock` must outlive this. `source` is part of every message.
  TofPipeline(const TofConfig& config, const PublishConfig& publish, const std::string& source, Publisher& publisher,
              const Clock& clock);

  /// Takes a complete new frame; its exposure time if it is to be measured, else empty, and counted.
  std::optional<MappedTime> take(const DepthFrame& frame);
  /// Takes the result of a frame, which is published before this returns. Its report; empty if the result is not fit to
  /// be sent.
  std::optional<TofReport> done(const TofWorker::Done& done);

  /// Sets the limits for publishing, from now on.
  void set_publish(const PublishConfig& publish) { gate_.set_max_age(publish.max_age_ns()); }

  /// Whether poses stopped or came since the last call, or the part that came of what was expected passed a limit; the
  /// log tells it.
  bool state_changed(const FrameSourceStatus& camera, std::int64_t monotonic_ns);

  SourceHealth health(const std::string& device, const FrameSourceStatus& camera, std::int64_t monotonic_ns);
  const TofCounters& counters() const { return counters_; }
  /// Readable notice that this computer's clock was recently set; empty otherwise.
  std::string clock_notice(std::int64_t monotonic_ns) const { return clock_step_.notice(monotonic_ns); }

 private:
  std::optional<MappedTime> time_of(const DepthFrame& frame);
  void refuse_jump(TofReport& report, const MappedTime& time);
  std::optional<TofReport> answer(const TofResult& answer, const MappedTime& time);
  void count(const TofReport& report);
  TofReport report_of(const TofResult& answer, const MappedTime& time) const;
  bool average(TofReport& report);
  void publish(TofReport& report);
  void assess(SourceHealth& health, const FrameSourceStatus& camera, std::int64_t monotonic_ns) const;
  NamedCounts named_counts(const FrameSourceStatus& camera) const;

  TofConfig config_;
  std::string source_;
  const Clock& host_clock_;
  RateLimitedLog log_;
  FrameClock clock_;
  PoseJumpCheck jump_check_;
  PoseAverage average_;
  TofCounters counters_;
  PublishGate gate_;
  std::string last_refusal_;  // with advice
  std::int64_t last_utc_ns_ = 0;
  ClockStepMonitor clock_step_;
  RateMonitor rate_;
  FrameDelivery delivery_;
  SourceChanges changes_;
  // Stages of a frame: first packet to last, waiting for the loop and for the frame before, estimator; and from its
  // first packet to LCM.
  LatencyHistogram transport_;
  LatencyHistogram waiting_;
  LatencyHistogram estimator_;
  std::array<LatencyHistogram, tof::kTofStages> estimator_stages_;
  LatencyHistogram latency_;
};

}  // namespace pharos::host
