// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "host/publish/messages.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

constexpr double kNsPerUsReal = 1e3;

std::vector<counter_t> counters_of(const NamedCounts& counts) {
  std::vector<counter_t> counters(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counters[i].name = counts[i].name;
    counters[i].value = counts[i].value;
  }
  return counters;
}

source_status_t source_message(const SourceHealth& health) {
  source_status_t message{};
  message.source = health.source;
  message.target = health.target;
  message.state = name_of(health.state);
  message.message = health.message;
  message.device = health.device;
  message.identity = health.identity;
  message.data_age_us = health.data_age_ns < 0 ? -1 : health.data_age_ns / kNsPerUs;
  message.pose_age_us = health.pose_age_ns < 0 ? -1 : health.pose_age_ns / kNsPerUs;
  message.pose_rate_hz = health.pose_rate_hz;
  message.clock_sigma_us = health.clock_sigma_ns / kNsPerUsReal;
  message.clock_drift_ppm = health.clock_drift_ppm;
  message.counters = counters_of(health.counters);
  message.counter_count = static_cast<std::int32_t>(message.counters.size());
  return message;
}

bool bad(const SourceHealth& source) {
  return source.state == SourceState::kError || source.state == SourceState::kGone;
}

// The common state of all sources, and the first error message.
void fill_state(const DaemonHealth& health, status_t& message) {
  const auto& sources = health.sources;
  const auto worst = std::find_if(sources.begin(), sources.end(),
                                  [](const SourceHealth& source) { return source.state != SourceState::kOk; });
  message.state = worst == sources.end() && health.message.empty() ? "ok" : "degraded";
  if (!sources.empty() && std::all_of(sources.begin(), sources.end(), bad)) message.state = "error";
  message.message = health.message;
  if (message.message.empty() && worst != sources.end()) message.message = worst->target + ": " + worst->message;
}

}  // namespace

const char* name_of(SourceState state) {
  switch (state) {
    case SourceState::kOk:
      return "ok";
    case SourceState::kDegraded:
      return "degraded";
    case SourceState::kWaiting:
      return "waiting";
    case SourceState::kStale:
      return "stale";
    case SourceState::kGone:
      return "gone";
    case SourceState::kError:
      return "error";
  }
  return "error";
}

status_t status_message(const DaemonHealth& health, std::int64_t sequence) {
  status_t message{};
  message.utime = health.utc_ns / kNsPerUs;
  message.sequence = sequence;
  message.host = health.host;
  message.version = health.version;
  message.uptime_us = health.uptime_ns / kNsPerUs;
  fill_state(health, message);
  message.counters = counters_of(health.counters);
  message.counter_count = static_cast<std::int32_t>(message.counters.size());
  for (const SourceHealth& source : health.sources) message.sources.push_back(source_message(source));
  message.source_count = static_cast<std::int32_t>(message.sources.size());
  return message;
}

}  // namespace pharos::host
