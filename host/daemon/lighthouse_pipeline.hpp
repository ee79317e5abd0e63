// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "host/clock/clock_map.hpp"
#include "host/config/daemon_config.hpp"
#include "host/daemon/arrival.hpp"
#include "host/daemon/calibration_memory.hpp"
#include "host/daemon/clock_step_monitor.hpp"
#include "host/daemon/delivery_monitor.hpp"
#include "host/daemon/lighthouse_counters.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/daemon/source_changes.hpp"
#include "host/daemon/unwrapped_counters.hpp"
#include "host/publish/cycle_report.hpp"
#include "host/publish/publish_gate.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/latency_histogram.hpp"
#include "host/stations/world_estimator.hpp"
#include "pharos/report/link_decoder.hpp"
#include "pharos/tracking/calibrated_tracker.hpp"

namespace pharos::host {

/// One target's bytes to poses on LCM: link -> sweeps -> poses -> UTC -> gate. Independent of ports and files.
class LighthousePipeline {
 public:
  /// `publisher`, `clock` and `memory` must outlive this. `source` is part of every message.
  /// `line_baud`: speed of the serial line, for the minimum transmission time of a frame; 0 if bytes arrive at once.
  LighthousePipeline(const TargetConfig& config, const PublishConfig& publish, const std::string& source,
                     Publisher& publisher, const Clock& clock, CalibrationMemory& memory, int line_baud);

  /// Takes bytes that were just read. Every cycle that they complete is published before this returns.
  void push(std::span<const std::uint8_t> bytes, const Arrival& arrival);
  /// The port was lost: an incomplete frame is dropped, and the target may come back with another clock.
  void line_lost();
  /// End of a recording: publishes the cycle still held back.
  void end_of_input();

  /// Sets the limits for publishing, from now on.
  void set_publish(const PublishConfig& publish);
  /// Takes over sensor positions, stations and systematic errors of another calibration of the same target, and
  /// restarts the tracker.
  void recalibrate(const TargetConfig& config);

  /// The health of this pipeline; `port_error` is the error of its port (empty: open). Ages are relative to
  /// `monotonic_ns`, on the clock of the arrivals.
  SourceHealth health(const std::string& device, SourceState port_state, const std::string& port_error,
                      std::int64_t monotonic_ns);

  /// Whether since the last call the target was found or lost, or the state by DeliveryMonitor changed; changes are
  /// logged.
  bool state_changed(std::int64_t monotonic_ns);

  /// While poses have the flag `clock_set`: by how much this computer's clock was set, as text; otherwise empty.
  std::string clock_notice(std::int64_t monotonic_ns) const { return clock_step_.notice(monotonic_ns); }

  const TargetCounters& counters() const { return counters_; }
  /// From reading the last byte of a cycle to its pose on LCM.
  const LatencyHistogram& latency() const { return latency_; }

 private:
  // Counters since the target's last start.
  struct BoardCounters {
    UnwrappedCounters decoder;
    UnwrappedCounters device;
  };

  void handle(const report::LinkEvent& event);
  void take(const lighthouse::Sweep& sweep);
  void take(const lighthouse::OotxPayload& payload);
  void take(const lighthouse::Lh2Sweep& sweep);
  void take(const report::Lh2OotxReport& report);
  void take(const report::PoseReport& pose);
  void take(const report::DecoderReport& report);
  void take(const report::DeviceReport& report);
  void take(const report::EdgesReport& edges);
  void take(const wire::Time& time);
  void take(const wire::Hello& hello);
  template <class Other>
  void take(const Other&) {
    ++counters_.unexpected_events;
  }

  void check_relative_pose();
  void check_identity(const wire::Hello& hello);
  bool refuse_wrong_target(MeasurementOutcome& outcome);
  void check_clock(const report::LinkEvent& event);
  void restart(const char* why);
  void answer(const track::EpochResult& result);
  void answer_world();
  bool stamp_time(MeasurementHeader& report, std::int64_t time_ticks);
  bool stamp(CycleReport& report, std::uint8_t station, std::int64_t time_ticks);
  void publish_bearings(const CycleReport& report, const track::EpochResult& result);
  void count_answer(const Result<LighthousePoseEstimate, pose::Refusal>& pose);
  void log_foreign_version();
  static std::string unsupported_version_text(std::uint8_t version);
  void assess(SourceHealth& health, std::int64_t monotonic_ns) const;
  NamedCounts named_counts() const;

  TargetConfig config_;
  PublishConfig publish_;
  std::string source_;
  const Clock& host_clock_;
  CalibrationMemory& memory_;

  report::LinkDecoder link_;
  ClockMap clock_;
  tracking::StationSurvey survey_;  // of config_
  tracking::CalibratedTracker<tracking::MethodTracker> tracker_;
  std::optional<WorldEstimator> world_;  // of generation 2
  int line_baud_ = 0;
  Arrival arrival_;
  std::int64_t push_began_ns_ = 0;  // this computer's monotonic time, also in a replay
  std::size_t frame_bytes_ = 0;     // since the last good frame
  std::int64_t newest_ticks_ = 0;
  bool any_ticks_ = false;
  bool time_went_back_ = false;  // the last time received was far before newest_ticks_
  std::optional<std::pair<std::uint32_t, std::uint16_t>> known_start_;  // unique id and start count of the last Hello

  ClockStepMonitor clock_step_;

  TargetCounters counters_;
  PublishGate gate_;
  PublishGate board_gate_;
  BoardCounters board_counters_;
  RateLimitedLog log_;
  std::string identity_;
  std::string identity_fault_;  // why the board is not the expected one; empty if it is
  LatencyHistogram latency_;
  std::int64_t last_bytes_ns_ = -1;  // monotonic, like the others
  std::int64_t last_sweep_ns_ = -1;
  RateMonitor rate_;
  std::string last_refusal_;
  DeliveryMonitor delivery_;
  SourceChanges changes_;
  bool relative_pose_rejected_ = false;
  std::optional<std::uint8_t> last_logged_version_;
};

}  // namespace pharos::host
