// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/clock/clock_map.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/device/frame_source.hpp"
#include "host/publish/health.hpp"
#include "host/runtime/latency_histogram.hpp"

namespace pharos::host {

// Parts of the health that several pipelines have in common.

/// What a camera's state makes of the health of what is measured with it.
SourceState state_of(CameraState camera);

/// STAGE_p50_us, STAGE_p99_us and STAGE_max_us.
void add_times(NamedCounts& counts, const std::string& stage, const LatencyHistogram& times);

/// clock.COUNTER.
void add_clock(NamedCounts& counts, const ClockCounters& clock);

}  // namespace pharos::host
