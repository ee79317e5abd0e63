// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/wire/frame.hpp"

namespace pharos::wire {

/// Makes frames and numbers them: one encoder per direction of a line, numbered from 0 at start.
class FrameEncoder {
 public:
  /// Writes one whole frame, delimiters included, into `out` (kMaxLineFrame bytes always suffice; line_size() of the
  /// payload is enough). Returns the bytes written; 0 when the payload is longer than kMaxPayload or `out` is too
  /// small, and then no number is used up.
  std::size_t encode(MessageType type, std::span<const std::uint8_t> payload, std::span<std::uint8_t> out);
  /// A frame had to be dropped (line too slow): uses up its number, so that the receiver counts it as lost.
  void skip() { ++next_sequence_; }
  std::uint16_t next_sequence() const { return next_sequence_; }

 private:
  std::uint16_t next_sequence_ = 0;
};

}  // namespace pharos::wire
