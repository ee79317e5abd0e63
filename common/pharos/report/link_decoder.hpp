// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reports.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/hello_message.hpp"
#include "pharos/wire/loader_messages.hpp"

namespace pharos::report {

/// Every possible content of one good frame.
using LinkEvent = std::variant<lighthouse::Sweep, lighthouse::OotxPayload, lighthouse::Lh2Sweep, Lh2OotxReport,
                               PoseReport, DecoderReport, DeviceReport, EdgesReport, wire::Time, wire::Hello,
                               wire::Command, wire::Ack, wire::Nak, wire::LoaderQuery, wire::LoaderInfo,
                               wire::LoaderBegin, wire::LoaderData, wire::LoaderVerify, wire::LoaderStart>;

/// The values of `event`, for frames already found; empty for invalid payloads and for unknown counter groups.
std::optional<LinkEvent> decode_event(const wire::Frame& frame);

/// Newest instant of the target's clock in the event, ticks; it was sent after that. Empty for events without a time.
std::optional<std::int64_t> newest_ticks(const LinkEvent& event);

/// The host's side of the line: bytes in, events out. All that is dropped is counted by cause.
class LinkDecoder {
 public:
  std::optional<LinkEvent> push(std::uint8_t byte);
  /// The line was unplugged: a partial frame is dropped.
  void restart() { frames_.restart(); }

  const wire::LinkCounters& counters() const { return frames_.counters(); }
  /// Protocol version of the last frame of another version, if there was one.
  std::optional<std::uint8_t> unsupported_version() const { return frames_.unsupported_version(); }

 private:
  wire::FrameDecoder frames_;
};

}  // namespace pharos::report
