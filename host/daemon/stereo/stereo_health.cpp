// SPDX-License-Identifier: Apache-2.0
// The health of StereoPipeline.
#include "host/daemon/health_parts.hpp"
#include "host/daemon/stereo/stereo_pipeline.hpp"

namespace pharos::host {

bool StereoPipeline::state_changed(const PairSourceStatus& pairs, std::int64_t monotonic_ns) {
  delivery_.on_frames(pairs.pairs, monotonic_ns);
  jump_check_.on_contests(pairs.contests, monotonic_ns);
  return changes_.update(rate_, delivery_.assess(monotonic_ns), last_refusal_, log_, monotonic_ns);
}

SourceHealth StereoPipeline::health(const std::string& device, const PairSourceStatus& pairs,
                                    std::int64_t monotonic_ns) {
  SourceHealth health;
  health.source = source_;
  health.target = target_;
  health.device = device;
  health.identity = pairs.identity;
  rate_.report(health, monotonic_ns);
  health.clock_sigma_ns = pairs.clock_sigma_ns;
  health.clock_drift_ppm = pairs.clock_drift_ppm;
  health.counters = named_counts(pairs);
  assess(health, pairs, monotonic_ns);
  return health;
}

// In the order of processing: reports the error of the earliest stage.
void StereoPipeline::assess(SourceHealth& health, const PairSourceStatus& pairs, std::int64_t now_ns) const {
  health.state = state_of(pairs.state);
  health.message = pairs.error;
  if (health.state != SourceState::kOk) return;
  const bool pose = changes_.in_sight(rate_, now_ns);
  const DeliveryAssessment delivery = delivery_.assess(now_ns);
  if (pose && delivery.state != SourceState::kOk) {
    health.state = delivery.state;
    health.message = delivery.message;
    return;
  }
  if (pose && last_refusal_.empty()) return;
  health.state = pose ? SourceState::kOk : SourceState::kWaiting;
  if (rate_.data_stopped(now_ns) || !rate_.any_data()) {
    if (rate_.any_data() && !pose) health.state = SourceState::kStale;
    if (health.message.empty()) {
      health.message =
          rate_.any_data() ? "no pairs come any more: see frames_without_partner of each side" : "no pair came yet";
    }
  } else if (!last_refusal_.empty()) {
    health.message = "no pose: " + last_refusal_;
  } else if (!pose) {
    health.message = counters_.pairs_stale > 0 ? "pairs are older than publish.max_age_s when they are measured"
                                               : "no pair was answered yet";
  }
}

NamedCounts StereoPipeline::named_counts(const PairSourceStatus& pairs) const {
  NamedCounts counts;
  for_each_counter(counters_, [&](const char* name, std::int64_t value) { counts.push_back({name, value}); });
  for (const auto& [reason, count] : counters_.refused) counts.push_back({"refused." + reason, count});
  counts.insert(counts.end(), pairs.counters.begin(), pairs.counters.end());
  counts.insert(counts.end(), figures_.begin(), figures_.end());
  add_times(counts, "waiting", waiting_);
  add_times(counts, "estimator", estimator_);
  for (const auto& [stage, times] : stages_) add_times(counts, "estimator." + stage, times);
  add_times(counts, "latency", latency_);
  counts.push_back({"log_lines_held_back", static_cast<std::int64_t>(log_.suppressed())});
  return counts;
}

}  // namespace pharos::host
