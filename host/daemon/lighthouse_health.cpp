// SPDX-License-Identifier: Apache-2.0
// The health of LighthousePipeline.
#include "host/daemon/health_parts.hpp"
#include "host/daemon/lighthouse_pipeline.hpp"
#include "host/support/time_units.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::host {
namespace {

// Counters, hellos and times come at least once a second; twice that time without data is silence.

bool within(std::int64_t event_ns, std::int64_t now_ns) { return event_ns >= 0 && now_ns - event_ns < kSilence_ns; }

std::string seconds_text(std::int64_t since_ns, std::int64_t now_ns) {
  return std::to_string((now_ns - since_ns) / kNsPerSecond) + " s";
}

}  // namespace

SourceHealth LighthousePipeline::health(const std::string& device, SourceState port_state,
                                        const std::string& port_error, std::int64_t monotonic_ns) {
  SourceHealth health;
  health.source = source_;
  health.target = config_.name;
  health.device = device;
  health.identity = identity_;
  rate_.report(health, monotonic_ns);
  health.clock_sigma_ns = clock_.synchronised() ? static_cast<double>(clock_.sigma_ns()) : 0.0;
  health.clock_drift_ppm = clock_.drift_ppm();
  health.counters = named_counts();
  if (port_state == SourceState::kOk) {
    assess(health, monotonic_ns);
  } else {
    health.state = port_state;
    health.message = port_error;
  }
  return health;
}

// In the order of processing: reports the error of the earliest stage.
void LighthousePipeline::assess(SourceHealth& health, std::int64_t now_ns) const {
  health.state = SourceState::kWaiting;
  if (!identity_fault_.empty() && rate_.data_within(kSilence_ns, now_ns)) {
    health.state = SourceState::kError;
    health.message = identity_fault_;
  } else if (changes_.in_sight(rate_, now_ns)) {
    const DeliveryAssessment delivery = delivery_.assess(now_ns);
    health.state = delivery.state;
    health.message = delivery.message;
  } else if (last_bytes_ns_ < 0) {
    health.message = "nothing came from the target yet: is it powered, is this its port?";
  } else if (!within(last_bytes_ns_, now_ns)) {
    health.state = SourceState::kStale;
    health.message = "the target has been silent for " + seconds_text(last_bytes_ns_, now_ns);
  } else if (!rate_.data_within(kSilence_ns, now_ns) && last_logged_version_) {
    health.state = SourceState::kError;
    health.message = unsupported_version_text(*last_logged_version_);
  } else if (!rate_.data_within(kSilence_ns, now_ns)) {
    health.state = SourceState::kError;
    health.message = "bytes come but no frame: is the baud rate that of the target?";
  } else if (last_sweep_ns_ < 0 || now_ns - last_sweep_ns_ > DeliveryMonitor::kOutOfSight_ns) {
    health.message = counters_.raw_edges > 0 ? "the target sends raw edges only: switch its diagnostic mode off"
                                             : "the target sees no station";
  } else {
    health.message = last_refusal_.empty() ? "no cycle was answered yet" : "no pose: " + last_refusal_;
  }
}

NamedCounts LighthousePipeline::named_counts() const {
  NamedCounts counts;
  const auto add = [&](const std::string& prefix) {
    return [&counts, prefix](const char* name, auto value, const char*) {
      counts.push_back({prefix + name, static_cast<std::int64_t>(value)});
    };
  };
  for_each_counter(counters_, add(""));
  for (std::size_t i = 1; i < counters_.refused.size(); ++i) {
    const std::string name = pose::name_of(static_cast<pose::Refusal>(i));
    if (i <= static_cast<std::size_t>(pose::kLastRefusal)) {
      counts.push_back({"cycles_refused_" + name, counters_.refused[i]});
    }
  }
  add_times(counts, "latency", latency_);
  wire::for_each_counter(link_.counters(), add("link."));
  add_clock(counts, clock_.counters());
  counts.push_back({"log_lines_held_back", static_cast<std::int64_t>(log_.suppressed())});
  board_counters_.decoder.visit(lighthouse::DecoderCounters{}, add("decoder."));
  board_counters_.device.visit(wire::DeviceCounters{}, add("device."));
  return counts;
}

}  // namespace pharos::host
