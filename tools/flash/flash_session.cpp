// SPDX-License-Identifier: Apache-2.0
#include "tools/flash/flash_session.hpp"

#include <algorithm>

namespace pharos::tools {
namespace {

/// FrameDecoder drops numbers at most 63 behind the last as repeated.
constexpr int kBeyondReplay = 64;

}  // namespace

std::optional<NumberedReply> as_reply(const wire::Frame& frame) {
  if (frame.type == wire::MessageType::kAck) {
    const auto ack = wire::decode_payload<wire::Ack>(frame.payload);
    if (ack) return NumberedReply{ack->for_type, ack->for_sequence, {{}, ack->value}};
  } else if (frame.type == wire::MessageType::kNak) {
    const auto nak = wire::decode_payload<wire::Nak>(frame.payload);
    if (nak) return NumberedReply{nak->for_type, nak->for_sequence, {nak->reason, nak->value}};
  }
  return std::nullopt;
}

FlashSession::FlashSession(FlashLine& line) : line_(line) {
  // Sequence numbers of another run rarely equal ours; where they do, skip_numbers() separates them.
  const auto start = static_cast<std::uint16_t>(line.now_ns() >> 10);
  for (std::uint16_t number = 0; number != start; ++number) encoder_.skip();
}

std::uint16_t FlashSession::send_payload(wire::MessageType type, std::span<const std::uint8_t> payload) {
  std::array<std::uint8_t, wire::kMaxLineFrame> frame{};
  const std::uint16_t sequence = encoder_.next_sequence();
  const std::size_t size = encoder_.encode(type, payload, frame);
  line_.write(std::span(frame).first(size));
  return sequence;
}

std::optional<wire::Frame> FlashSession::receive(std::int64_t deadline_ns) {
  for (;;) {
    while (begin_ != end_) {
      if (const auto frame = decoder_.push(received_[begin_++])) return frame;
    }
    begin_ = 0;
    end_ = line_.read(received_, deadline_ns);
    if (end_ == 0 && line_.now_ns() >= deadline_ns) return std::nullopt;
  }
}

std::optional<Reply> FlashSession::await_reply(wire::MessageType type, std::span<const std::uint16_t> sent,
                                               std::int64_t deadline_ns) {
  while (const auto frame = receive(deadline_ns)) {
    const auto response = as_reply(*frame);
    if (response && response->for_type == static_cast<std::uint8_t>(type) &&
        std::ranges::find(sent, response->for_sequence) != sent.end()) {
      return response->reply;
    }
  }
  return std::nullopt;
}

void FlashSession::forget_received() {
  // A port buffers a few of them; the limit ends the loop where a target sends without pause.
  constexpr int kMaxReads = 64;
  for (int i = 0; i < kMaxReads && line_.read(received_, line_.now_ns()) > 0; ++i) {
  }
  begin_ = end_ = 0;
  decoder_.restart();
}

void FlashSession::end_partial_frame() { line_.write(std::array{wire::kFrameDelimiter}); }

void FlashSession::skip_numbers() {
  for (int i = 0; i < kBeyondReplay; ++i) encoder_.skip();
}

}  // namespace pharos::tools
