// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "host/config/daemon_config.hpp"
#include "host/daemon/frame_delivery.hpp"
#include "host/daemon/pose_jump_check.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/daemon/source_changes.hpp"
#include "host/daemon/stereo/pair_source.hpp"
#include "host/daemon/stereo/pair_worker.hpp"
#include "host/daemon/stereo/stereo_counters.hpp"
#include "host/publish/publish_gate.hpp"
#include "host/publish/spin_report.hpp"
#include "host/publish/stereo_report.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/latency_histogram.hpp"

namespace pharos::host {

/// One system of one rig: pairs to poses on LCM. Independent of cameras, files and threads.
class StereoPipeline {
 public:
  /// `publisher` and `clock` must outlive this. `source` is part of every message.
  StereoPipeline(const StereoConfig& config, const PublishConfig& publish, const std::string& source,
                 Publisher& publisher, const Clock& clock);

  /// Takes a new pair; true if it is recent enough to be measured.
  bool take(const StereoPair& pair);
  /// Counts a pair that was dropped for a newer one before it was measured.
  void dropped() { ++counters_.pairs_dropped; }
  /// Takes the result of a pair, which is published before this returns. `clock_was_set`: this computer's clock,
  /// recently. Its report; empty if it is not fit to be sent.
  std::optional<StereoReport> done(const PairWorker::Done& done, bool clock_was_set);

  /// Sets the limits for publishing, from now on.
  void set_publish(const PublishConfig& publish) {
    gate_.set_max_age(publish.max_age_ns());
    spin_gate_.set_max_age(publish.max_age_ns());
  }

  /// Whether poses stopped or came since the last call, or the part that came of what was expected passed a limit; the
  /// log tells it.
  bool state_changed(const PairSourceStatus& pairs, std::int64_t monotonic_ns);

  SourceHealth health(const std::string& device, const PairSourceStatus& pairs, std::int64_t monotonic_ns);
  const StereoCounters& counters() const { return counters_; }
  const std::string& source() const { return source_; }

 private:
  StereoReport report_of(const StereoPair& pair, const PairResult& answer) const;
  void refuse_jump(StereoReport& report, std::int64_t time_ns);
  void publish_spin(const StereoReport& report, const SpinResult& answer);
  void count(const StereoReport& report, std::int64_t monotonic_ns);
  void assess(SourceHealth& health, const PairSourceStatus& pairs, std::int64_t monotonic_ns) const;
  NamedCounts named_counts(const PairSourceStatus& pairs) const;

  std::string name_;
  std::string target_;
  std::string source_;
  const Clock& clock_;
  bool is_loose_;
  PoseJumpCheck jump_check_;
  RateLimitedLog log_;
  StereoCounters counters_;
  PublishGate gate_;
  PublishGate spin_gate_;
  std::string last_refusal_;  // with advice; of the last pair, empty if it has a pose
  NamedCounts figures_;       // of the estimator
  RateMonitor rate_;
  FrameDelivery delivery_;
  SourceChanges changes_;
  // Stages of a pair: waiting for its estimator, that and its parts; and from the light to LCM.
  LatencyHistogram waiting_;
  LatencyHistogram estimator_;
  std::map<std::string, LatencyHistogram> stages_;
  LatencyHistogram latency_;
};

}  // namespace pharos::host
