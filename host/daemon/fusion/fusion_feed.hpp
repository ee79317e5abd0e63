// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "host/daemon/fusion/fusion_stage.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/daemon/source.hpp"
#include "host/publish/publish_gate.hpp"
#include "host/publish/target_state_message.hpp"
#include "host/runtime/job_worker.hpp"
#include "host/runtime/latency_histogram.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// [vehicle]: the poses that all sources publish to PHAROS_TARGET_STATE. A state follows every pose, and comes at a
/// rate, predicted to now.
///
/// Live, the estimator runs in a thread of its own, and at most kMaxWaiting jobs wait for it. Of a recording it runs at
/// once, and "now" is the newest pose's time: the same recording gives the same states.
class FusionFeed final : public Source {
 public:
  static constexpr std::size_t kMaxWaiting = 64;

  /// Throws InputError where mountings and choices do not fit.
  FusionFeed(const SourceContext& context, const VehicleConfig& config);
  ~FusionFeed() override;

  const std::string& name() const override { return name_; }
  void attend() override;
  void reconfigure() override;
  std::vector<SourceHealth> health() override;
  bool finished() const override { return !worker_ || worker_->idle(); }

  /// A pose that was published.
  void take(const char* channel, const pose_t& message);
  /// Asks for the state now; the timer calls it.
  void look();

 private:
  using Worker = JobWorker<FusionJob, FusionResult>;

  void start_timer();
  void run(FusionJob job);
  void run_recorded(FusionJob job);
  void on_results();
  void done(const FusionJob& job, const FusionResult& result, std::int64_t waited_ns, std::int64_t took_ns);
  void publish(const FusionJob& job, const FusionResult& result);
  void note(const fusion::TargetState& state);
  // fusion_health.cpp
  void assess(SourceHealth& health, std::int64_t now_ns) const;
  NamedCounts counts() const;

  const SourceContext& context_;
  VehicleConfig config_;
  bool recorded_;
  std::string name_ = "vehicle";
  std::string source_;
  RateLimitedLog log_;
  PoseIntake intake_;
  FusionStage stage_;
  std::int64_t not_finite_ = 0, stale_ = 0;
  PublishGate gate_;
  Timer timer_;
  std::int64_t next_look_ns_ = 0;  // of a recording
  std::int64_t newest_ns_ = 0;     // of a recording
  std::optional<FusionResult> last_;
  std::int64_t last_ns_ = 0;  // when it came
  bool changed_ = false;      // since the last attend()
  bool stations_told_ = false;
  std::array<std::int64_t, static_cast<std::size_t>(fusion::Refusal::kCount)> refused_{};
  std::int64_t poses_late_ = 0, poses_dropped_ = 0, looks_dropped_ = 0, faults_ = 0;
  RateMonitor rate_;
  LatencyHistogram in_order_, late_, waiting_;
  std::unique_ptr<Worker> worker_;  // last member, as its thread uses the stage
};

/// Opens [vehicle], if there is one.
std::size_t open_fusion_feed(const SourceContext& context, SourceList& sources);

}  // namespace pharos::host
