// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

// A frame on the line:  00 | byte-stuffed (version, type, sequence, payload, CRC-32) | 00.  See proto/README.md.

/// Delimiter before and after every frame; it never occurs inside.
inline constexpr std::uint8_t kFrameDelimiter = 0;

/// Longest payload: a sweep with every hit it can hold has 468 bytes.
inline constexpr std::size_t kMaxPayload = 512;
/// version u8, type u8, sequence u16 before the payload; CRC-32 after it.
inline constexpr std::size_t kHeaderBytes = 4;
inline constexpr std::size_t kCrcBytes = 4;
inline constexpr std::size_t kMaxFrame = kHeaderBytes + kMaxPayload + kCrcBytes;

/// Bytes after stuffing `bytes` bytes: one more for every 254 begun.
constexpr std::size_t stuffed_size(std::size_t bytes) { return bytes + bytes / 254 + 1; }
/// Maximum bytes on the line of a frame with this payload, both delimiters included.
constexpr std::size_t line_size(std::size_t payload) { return 2 + stuffed_size(kHeaderBytes + payload + kCrcBytes); }
inline constexpr std::size_t kMaxLineFrame = line_size(kMaxPayload);

/// One good frame. `payload` belongs to the object that returned it and is valid until its next use.
struct Frame {
  MessageType type{};
  std::uint16_t sequence = 0;
  std::span<const std::uint8_t> payload;
};

}  // namespace pharos::wire
