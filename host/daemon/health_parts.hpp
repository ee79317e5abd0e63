// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/clock/clock_map.hpp"
#include "host/device/frame_source.hpp"
#include "host/publish/health.hpp"
#include "host/runtime/latency_histogram.hpp"

namespace pharos::host {

// Parts of the health that several pipelines have in common.

/// A source without data for this time is silent.
inline constexpr std::int64_t kSilence_ns = 2'000'000'000;

/// The state of a source by the state of its camera.
SourceState state_of(CameraState camera);

/// STAGE_p50_us, STAGE_p99_us and STAGE_max_us.
void add_times(NamedCounts& counts, const std::string& stage, const LatencyHistogram& times);

/// clock.COUNTER.
void add_clock(NamedCounts& counts, const ClockCounters& clock);

}  // namespace pharos::host
