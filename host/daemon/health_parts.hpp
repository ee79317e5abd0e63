// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/daemon/latency_histogram.hpp"
#include "host/device/frame_source.hpp"
#include "host/publish/health.hpp"

namespace pharos::host {

/// What a camera's state makes of the health of what is measured with it.
SourceState state_of(CameraState camera);

/// STAGE_p50_us, STAGE_p99_us and STAGE_max_us.
void add_times(NamedCounts& counts, const std::string& stage, const LatencyHistogram& times);

}  // namespace pharos::host
