// SPDX-License-Identifier: Apache-2.0
// The health of TofPipeline.
#include "host/daemon/health_parts.hpp"
#include "host/daemon/tof_pipeline.hpp"

namespace pharos::host {

bool TofPipeline::state_changed(const FrameSourceStatus& camera, std::int64_t monotonic_ns) {
  delivery_.on_frames(delivered(camera.counters), monotonic_ns);
  jump_check_.on_contests(camera.counters.camera_contested, monotonic_ns);
  return changes_.update(rate_, delivery_.assess(monotonic_ns), last_refusal_, log_, monotonic_ns);
}

SourceHealth TofPipeline::health(const std::string& device, const FrameSourceStatus& camera,
                                 std::int64_t monotonic_ns) {
  SourceHealth health;
  health.source = source_;
  health.target = config_.target;
  health.device = device;
  health.identity = camera.identity;
  rate_.report(health, monotonic_ns);
  health.clock_sigma_ns = static_cast<double>(clock_.sigma_ns());
  health.clock_drift_ppm = clock_.map().drift_ppm();
  health.counters = named_counts(camera);
  assess(health, camera, monotonic_ns);
  return health;
}

// In the order of processing: reports the error of the earliest stage.
void TofPipeline::assess(SourceHealth& health, const FrameSourceStatus& camera, std::int64_t now_ns) const {
  health.state = state_of(camera.state);
  health.message = camera.error;
  if (health.state != SourceState::kOk) return;
  if (changes_.in_sight(rate_, now_ns)) {
    const DeliveryAssessment delivery = delivery_.assess(now_ns);
    health.state = delivery.state;
    health.message = delivery.message;
    return;
  }
  health.state = SourceState::kWaiting;
  const FrameSourceCounters& counters = camera.counters;
  if (rate_.data_stopped(now_ns)) {
    health.state = SourceState::kStale;
    health.message = "no frame comes any more";
  } else if (!rate_.any_data()) {
    health.message = counters.frames_incomplete > 0
                         ? "only incomplete frames come: is packet_size more than the network passes?"
                         : "no frame came yet";
  } else {
    health.message = last_refusal_.empty() ? "no frame was answered yet" : "no pose: " + last_refusal_;
  }
}

NamedCounts TofPipeline::named_counts(const FrameSourceStatus& camera) const {
  NamedCounts counts;
  for_each_counter(counters_, [&](const char* name, std::int64_t value) { counts.push_back({name, value}); });
  for (const auto& [reason, count] : counters_.refused) counts.push_back({"refused." + reason, count});
  for_each_counter(camera.counters, [&](const char* name, std::int64_t value) {
    counts.push_back({std::string("device.") + name, value});
  });
  counts.push_back({"frames_in_broken_means", average_.discarded()});
  add_times(counts, "transport", transport_);
  add_times(counts, "waiting", waiting_);
  add_times(counts, "estimator", estimator_);
  for (std::size_t k = 0; k < tof::kTofStages; ++k) {
    add_times(counts, std::string("estimator.") + tof::name_of(static_cast<tof::TofStage>(k)), estimator_stages_[k]);
  }
  add_times(counts, "latency", latency_);
  add_clock(counts, clock_.map().counters());
  counts.push_back({"clock.ptp_state", static_cast<std::int64_t>(camera.ptp_state)});
  counts.push_back({"clock.by_ptp", clock_.by_ptp() ? 1 : 0});
  counts.push_back({"clock.ptp_doubted", clock_.ptp_doubted()});
  counts.push_back({"log_lines_held_back", static_cast<std::int64_t>(log_.suppressed())});
  return counts;
}

}  // namespace pharos::host
