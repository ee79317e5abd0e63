// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reports.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "pharos/wire/hello_message.hpp"

namespace pharos::report {

/// The target's side of the line: values in, bytes to send out.
///
/// Every call gives the bytes of one whole frame, valid until the next call; empty when there is nothing to send or the
/// value cannot be sent (counted by refused()). State: 1.1 kB.
class Reporter {
 public:
  using Bytes = std::span<const std::uint8_t>;

  Bytes report(const lighthouse::Sweep& sweep);
  Bytes report(const lighthouse::OotxPayload& payload);
  Bytes report(const lighthouse::Lh2Sweep& sweep);
  Bytes report(const Lh2OotxReport& payload);
  Bytes report(const PoseReport& pose);
  Bytes report(const DecoderReport& counters);
  Bytes report(const DeviceReport& counters);
  /// The current clock; ten a second keep the host's clock mapping accurate.
  Bytes report_time(std::int64_t now_ticks) { return send(wire::Time{now_ticks}); }
  /// Diagnostic mode: takes the edge; returns a frame when one was full.
  Bytes report(const lighthouse::Edge& edge, std::uint32_t edges_lost);
  /// The same for a caller whose line is busy: makes no frame. False when the edge did not fit: flush_edges(), then
  /// again.
  bool hold(const lighthouse::Edge& edge, std::uint32_t edges_lost);
  /// Diagnostic mode: the edges held back, for when they are rare.
  Bytes flush_edges();

  /// Any message of wire/: Hello, Ack, Nak, LoaderInfo, …
  template <class M>
  Bytes send(const M& message) {
    const auto place = std::span(line_).subspan(kPayloadAt);
    const std::size_t payload = wire::encode_payload(message, place);
    if (payload == 0 && M::kMaxBytes > 0) return refuse();
    return frame(M::kType, place.first(payload));
  }
  // A frame that does not fit on the line is not sent: its number is used up, and the host counts the gap.

  /// Values that cannot be sent (a field out of its range).
  std::uint32_t refused() const { return refused_; }
  std::uint32_t frames() const { return frames_; }

 private:
  Bytes refuse();
  Bytes frame(wire::MessageType type, Bytes payload);

  wire::FrameEncoder encoder_;
  wire::RawEdgesPacker edges_;
  std::uint32_t edges_lost_ = 0;
  // A payload is written to the end of its frame's memory: the frame is made from the front, and with border, header
  // and stuffing it never overwrites payload that is still to be read.
  static constexpr std::size_t kPayloadAt = wire::kMaxLineFrame - wire::kMaxPayload;
  static_assert(kPayloadAt >= 1 + wire::kHeaderBytes + wire::stuffed_size(wire::kMaxPayload) - wire::kMaxPayload);
  std::array<std::uint8_t, wire::kMaxLineFrame> line_{};
  std::uint32_t frames_ = 0;
  std::uint32_t refused_ = 0;
};

}  // namespace pharos::report
