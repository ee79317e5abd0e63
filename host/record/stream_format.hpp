// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pharos::host {

/// Head of a recorded serial stream: everything that is needed to read the recording.
struct StreamHeader {
  std::string target;  // name in the configuration, at most 255 bytes
  std::uint32_t baud = 0;
  std::int64_t utc_ns = 0;        // when the file was begun
  std::int64_t monotonic_ns = 0;  // the same instant on the recording host's monotonic clock
};

/// Bytes as received.
struct StreamChunk {
  std::int64_t utc_ns = 0;  // of reading them
  std::int64_t monotonic_ns = 0;
  std::uint64_t lost_before = 0;  // bytes that arrived before these and could not be recorded (disk full)
  std::span<const std::uint8_t> bytes;
};

// The layout, little-endian (see README.md):
//   head:  magic 8, version u8, name length u8, baud u32, utc i64, monotonic i64, name, CRC-32
//   chunk: mark u8, byte count u16, utc i64, monotonic i64, bytes, CRC-32
// The CRC is over all bytes of the head or chunk before it.
namespace stream_format {

/// As PNG's: a byte above 127 and a line end reveal a file that was converted as text.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'P', 'H', 'R', 'A', 'W', '\r', '\n'};
inline constexpr std::uint8_t kVersion = 1;
inline constexpr std::size_t kHeadBytes = 30;  // without name and CRC
inline constexpr std::size_t kCrcBytes = 4;
inline constexpr std::uint8_t kDataMark = 0xC5;
/// A chunk of 8 bytes: the number of bytes lost before it.
inline constexpr std::uint8_t kLossMark = 0xC6;
inline constexpr std::size_t kChunkHeadBytes = 19;
/// More than one read of a serial port returns; small, so that a search after damage is quick.
inline constexpr std::size_t kMaxChunkBytes = 16384;

std::vector<std::uint8_t> encode_head(const StreamHeader& header);
/// Appends the chunk to `out`, after a loss chunk where bytes were lost. At most kMaxChunkBytes.
void append_chunk(const StreamChunk& chunk, std::vector<std::uint8_t>& out);

}  // namespace stream_format
}  // namespace pharos::host
