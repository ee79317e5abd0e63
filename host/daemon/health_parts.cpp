// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/health_parts.hpp"

#include "host/support/time_units.hpp"

namespace pharos::host {
SourceState state_of(CameraState camera) {
  switch (camera) {
    case CameraState::kOpen:
      return SourceState::kOk;
    case CameraState::kSilent:
      return SourceState::kStale;
    case CameraState::kGone:
      return SourceState::kGone;
    case CameraState::kTaken:
    case CameraState::kWrong:
      return SourceState::kError;
  }
  return SourceState::kError;
}

void add_times(NamedCounts& counts, const std::string& stage, const LatencyHistogram& times) {
  counts.push_back({stage + "_p50_us", times.quantile_ns(0.5) / kNsPerUs});
  counts.push_back({stage + "_p99_us", times.quantile_ns(0.99) / kNsPerUs});
  counts.push_back({stage + "_max_us", times.max_ns() / kNsPerUs});
}

void add_clock(NamedCounts& counts, const ClockCounters& clock) {
  const auto add = [&counts](const char* name, std::uint64_t value) {
    counts.push_back({std::string("clock.") + name, static_cast<std::int64_t>(value)});
  };
  add("pairs", clock.pairs);
  add("pairs_ignored", clock.pairs_ignored);
  add("resynchronised", clock.resynchronised);
  add("host_steps", clock.host_steps);
  add("host_jumps", clock.host_jumps);
}

}  // namespace pharos::host
