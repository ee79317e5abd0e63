// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/wire/frame.hpp"
#include "pharos/wire/hello_message.hpp"

namespace pharos::boot {

/// Makes and numbers the loader's frames: wire::FrameEncoder for 4 KiB. None is longer than Hello, so that no run
/// between two zeros fills a block of stuffing.
class FrameSender {
 public:
  static constexpr std::size_t kMaxPayload = wire::Hello::kMaxBytes;

  /// A whole frame with its borders; valid until the next call. `payload`: 1 to kMaxPayload bytes (the loader sends no
  /// empty one).
  std::span<const std::uint8_t> encode(wire::MessageType type, std::span<const std::uint8_t> payload);

 private:
  static_assert(wire::kHeaderBytes + kMaxPayload + wire::kCrcBytes < 254);

  /// A frame as it goes out: border, first code of the stuffing, the stuffed bytes, border.
  struct Line {
    std::uint8_t delimiter;
    std::uint8_t code;
    std::uint8_t version;
    std::uint8_t type;
    std::uint16_t sequence;
    std::array<std::uint8_t, kMaxPayload + wire::kCrcBytes + 1> rest;
  };

  Line line_{};
  std::uint16_t next_sequence_ = 0;
};

}  // namespace pharos::boot
