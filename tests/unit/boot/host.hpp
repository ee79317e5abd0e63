// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pharos/wire/codec.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/crc32.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "pharos/wire/hello_message.hpp"
#include "pharos/wire/loader_messages.hpp"
#include "unit/boot/virtual_target.hpp"

namespace pharos::boot::test {

/// Result of a request. Neither: no response.
struct Reply {
  std::optional<std::uint32_t> ack;
  std::optional<wire::NakReason> nak;
  std::uint32_t nak_value = 0;
};

/// The host's end of a virtual target's line, one request at a time.
class Host {
 public:
  explicit Host(VirtualTarget& target) : target_(target) {}

  template <class M>
  std::uint16_t send(const M& message) {
    std::array<std::uint8_t, M::kMaxBytes> payload{};
    std::array<std::uint8_t, wire::kMaxLineFrame> line{};
    const std::uint16_t sequence = encoder_.next_sequence();
    const std::size_t size = wire::encode_payload(message, payload);
    const std::size_t bytes = encoder_.encode(M::kType, std::span(payload).first(size), line);
    target_.machine.host_sends(std::span(line).first(bytes));
    return sequence;
  }

  /// The next message of this type; others are ignored.
  template <class M>
  std::optional<M> receive(std::int64_t ticks = 5 * kTicksPerSecond) {
    for (const std::int64_t end = target_.machine.now + ticks; target_.machine.now < end; target_.step()) {
      while (const auto frame = next_frame()) {
        const auto message = wire::decode_payload<M>(frame->payload);
        if (frame->type == M::kType && message) return *message;
      }
    }
    return std::nullopt;
  }

  template <class M>
  Reply ask(const M& message, std::int64_t ticks = 5 * kTicksPerSecond) {
    const std::uint16_t sequence = send(message);
    for (const std::int64_t end = target_.machine.now + ticks; target_.machine.now < end; target_.step()) {
      while (const auto frame = next_frame()) {
        if (frame->type == wire::MessageType::kAck) {
          const auto ack = wire::decode_payload<wire::Ack>(frame->payload);
          if (ack && ack->for_sequence == sequence) return {.ack = ack->value, .nak = {}};
        } else if (frame->type == wire::MessageType::kNak) {
          const auto nak = wire::decode_payload<wire::Nak>(frame->payload);
          if (nak && nak->for_sequence == sequence) return {.ack = {}, .nak = nak->reason, .nak_value = nak->value};
        }
      }
    }
    return {};
  }

  Reply begin(const Bytes& image, std::string_view board = "model") {
    wire::LoaderBegin begin;
    begin.image_bytes = static_cast<std::uint32_t>(image.size());
    begin.image_crc32 = wire::crc32(image);
    begin.board = wire::Text<24>(board);
    return ask(begin);
  }
  Reply data(const Bytes& image, std::size_t offset, std::size_t bytes = boot_image::kPageBytes) {
    wire::LoaderData data;
    data.offset = static_cast<std::uint32_t>(offset);
    for (std::size_t i = offset; i < std::min(offset + bytes, image.size()); ++i) data.data.push_back(image[i]);
    return ask(data);
  }
  /// Sends all blocks from `offset` on; returns the response to the first that was refused, else to the last.
  Reply all_data(const Bytes& image, std::size_t offset = 0) {
    Reply reply;
    for (; offset < image.size(); offset += boot_image::kPageBytes) {
      reply = data(image, offset);
      if (!reply.ack) return reply;
    }
    return reply;
  }
  /// Enters the loader of a target that runs or has just started. False: no response.
  bool enter() {
    target_.run(kTicksPerSecond);  // past the window
    if (target_.runs_application()) {
      if (!ask(wire::Command{wire::CommandCode::kEnterLoader, 0}).ack) return false;
    }
    send(wire::LoaderQuery{});
    return receive<wire::LoaderInfo>().has_value();
  }
  /// A complete flashing. True when every response was Ack; false where the target did not respond or refused.
  bool flash(const Bytes& image) {
    return enter() && begin(image).ack && all_data(image).ack && ask(wire::LoaderVerify{}).ack &&
           ask(wire::LoaderStart{}).ack;
  }

 private:
  std::optional<wire::Frame> next_frame() {
    Machine& machine = target_.machine;
    while (!machine.from_target.empty() && machine.from_target.front().when <= machine.now) {
      const std::uint8_t byte = machine.from_target.front().byte;
      machine.from_target.pop_front();
      if (const auto frame = decoder_.push(byte)) return frame;
    }
    return std::nullopt;
  }

  VirtualTarget& target_;
  wire::FrameEncoder encoder_;
  wire::FrameDecoder decoder_;
};

/// A target that runs `image`, flashed in its first slot, and has sent its Hello.
inline void start_with(VirtualTarget& target, Host& host, const Bytes& image) {
  target.power_on();
  (void)host.flash(image);
  target.run(kTicksPerSecond);
}

}  // namespace pharos::boot::test
