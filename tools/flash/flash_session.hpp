// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pharos/wire/codec.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "tools/flash/flash_line.hpp"

namespace pharos::tools {

/// The response to a request.
struct Reply {
  std::optional<wire::NakReason> refusal;  // empty: Ack
  std::uint32_t value = 0;
};

/// Frames to and from the target.
class FlashSession {
 public:
  explicit FlashSession(FlashLine& line);

  /// Sends a message; returns its sequence number.
  template <class M>
  std::uint16_t send(const M& message) {
    std::array<std::uint8_t, M::kMaxBytes> payload{};
    const std::size_t size = wire::encode_payload(message, payload);
    return send_payload(M::kType, std::span(payload).first(size));
  }
  /// The next frame received until `deadline_ns`. Its payload is valid until the next call.
  std::optional<wire::Frame> receive(std::int64_t deadline_ns);

  /// Sends a request until there is a response, at most `attempts` times, waiting `wait_ns` each. Empty: no response.
  template <class M>
  std::optional<Reply> request(const M& message, std::int64_t wait_ns, int attempts) {
    std::vector<std::uint16_t> sent;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      sent.push_back(send(message));
      if (const auto reply = await_reply(M::kType, sent, now_ns() + wait_ns)) return reply;
    }
    return std::nullopt;
  }

  /// Drops received bytes: those buffered in the port may be hours old.
  void forget_received();
  /// Sends a single delimiter, so that an incomplete frame at the target does not become part of the next one.
  void end_partial_frame();
  /// Leaves a gap in the sequence numbers, so that no receiver takes the next frame for a repeated one of another host.
  void skip_numbers();

  std::int64_t now_ns() { return line_.now_ns(); }
  const wire::LinkCounters& counters() const { return decoder_.counters(); }
  std::optional<std::uint8_t> unsupported_version() const { return decoder_.unsupported_version(); }

 private:
  std::uint16_t send_payload(wire::MessageType type, std::span<const std::uint8_t> payload);
  std::optional<Reply> await_reply(wire::MessageType type, std::span<const std::uint16_t> sent,
                                   std::int64_t deadline_ns);

  FlashLine& line_;
  wire::FrameEncoder encoder_;
  wire::FrameDecoder decoder_;
  std::array<std::uint8_t, 4096> received_{};
  std::size_t begin_ = 0;  // of the bytes not yet decoded
  std::size_t end_ = 0;
};

/// Content of an Ack or Nak, with the number of its request; empty for any other frame.
struct NumberedReply {
  std::uint8_t for_type = 0;
  std::uint16_t for_sequence = 0;
  Reply reply;
};
std::optional<NumberedReply> as_reply(const wire::Frame& frame);

}  // namespace pharos::tools
