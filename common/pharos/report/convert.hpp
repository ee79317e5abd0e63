// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reports.hpp"
#include "pharos/wire/counters_message.hpp"
#include "pharos/wire/lh2_sweep_message.hpp"
#include "pharos/wire/ootx_message.hpp"
#include "pharos/wire/pose_message.hpp"
#include "pharos/wire/raw_edges_message.hpp"
#include "pharos/wire/sweep_message.hpp"

namespace pharos::report {

// The core's values to wire messages and back. Sweeps, payloads, edges and counters survive exactly; of a pose, the
// covariance, residual and precision factors are rounded to float (1e-7), rotation to the double's quaternion (1e-16).

wire::Sweep to_wire(const lighthouse::Sweep& sweep);
/// The same message, written directly from the sweep: on a small stack its copy is half a kilobyte.
struct SweepInPlace {
  static constexpr wire::MessageType kType = wire::Sweep::kType;
  static constexpr std::size_t kMaxBytes = wire::Sweep::kMaxBytes;
  const lighthouse::Sweep& sweep;
};
void write(const SweepInPlace& message, wire::ByteWriter& out);
lighthouse::Sweep from_wire(const wire::Sweep& message);

wire::Ootx to_wire(const lighthouse::OotxPayload& payload);
lighthouse::OotxPayload from_wire(const wire::Ootx& message);

wire::Lh2Sweep to_wire(const lighthouse::Lh2Sweep& sweep);
lighthouse::Lh2Sweep from_wire(const wire::Lh2Sweep& message);
wire::Lh2Ootx to_wire(const Lh2OotxReport& report);
Lh2OotxReport from_wire(const wire::Lh2Ootx& message);

wire::Counters to_wire(const DecoderReport& report);
wire::Counters to_wire(const DeviceReport& report);
/// Counters that the message does not have stay 0; additional ones are ignored. The group must match.
DecoderReport decoder_report(const wire::Counters& message);
DeviceReport device_report(const wire::Counters& message);

wire::RawEdge to_wire(const lighthouse::Edge& edge);
EdgesReport from_wire(const wire::RawEdges& message);

wire::Pose to_wire(const PoseReport& report);
/// Empty when the message holds no valid pose: a quaternion off unit length by more than 1e-6, or a refusal that is not
/// in pose::Refusal.
std::optional<PoseReport> from_wire(const wire::Pose& message);

}  // namespace pharos::report
