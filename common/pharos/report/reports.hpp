// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/result.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/pose/solve.hpp"
#include "pharos/wire/counters_message.hpp"
#include "pharos/wire/raw_edges_message.hpp"

namespace pharos::report {

// Values sent besides sweeps and OOTX payloads, in the core's own types.

/// One cycle of one station solved on board; fields as in track::EpochResult.
struct PoseReport {
  std::uint8_t station = 0;
  std::uint8_t flags = 0;
  std::int64_t time_ticks = 0;
  int observations = 0;
  Result<LighthousePoseEstimate, pose::Refusal> pose = pose::Refusal::kTooFewSensors;
};

/// The decoder's counters at a time.
struct DecoderReport {
  std::int64_t time_ticks = 0;
  lighthouse::DecoderCounters counters;
};

/// The target program's own counters at a time.
struct DeviceReport {
  std::int64_t time_ticks = 0;
  wire::DeviceCounters counters;
};

/// OOTX of a Lighthouse 2.0 station; `payload.station` is its channel.
struct Lh2OotxReport {
  lighthouse::OotxPayload payload;
};

/// Diagnostic mode: edges in the order of capture.
struct EdgesReport {
  std::uint32_t edges_lost = 0;  // since the target's start
  StaticVector<lighthouse::Edge, wire::RawEdges::kMaxEdges> edges;
};

}  // namespace pharos::report
