// SPDX-License-Identifier: Apache-2.0
// The health of StereoPipeline.
#include "host/daemon/health_parts.hpp"
#include "host/daemon/stereo/stereo_pipeline.hpp"

namespace pharos::host {
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
  const bool pose = rate_.pose_within(kSilence_ns, now_ns);
  if (pose && last_refusal_.empty()) return;
  health.state = pose ? SourceState::kOk : SourceState::kWaiting;
  if (!rate_.data_within(kSilence_ns, now_ns)) {
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
