// SPDX-License-Identifier: Apache-2.0
#include "host/record/stream_format.hpp"

#include <algorithm>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::host::stream_format {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append_one(std::uint8_t mark, const StreamChunk& chunk, std::span<const std::uint8_t> bytes, Bytes& out) {
  const std::size_t begin = out.size();
  out.resize(begin + kChunkHeadBytes + bytes.size() + kCrcBytes);
  const auto room = std::span(out).subspan(begin);
  wire::ByteWriter writer(room);
  writer.put(mark);
  writer.put(static_cast<std::uint16_t>(bytes.size()));
  writer.put(chunk.utc_ns);
  writer.put(chunk.monotonic_ns);
  writer.put_bytes(bytes);
  writer.put(wire::crc32(room.first(room.size() - kCrcBytes)));
}

}  // namespace

std::vector<std::uint8_t> encode_head(const StreamHeader& header) {
  const std::size_t name = std::min<std::size_t>(header.target.size(), 255);
  Bytes out(kHeadBytes + name + kCrcBytes);
  wire::ByteWriter writer(out);
  writer.put_bytes(kMagic);
  writer.put(kVersion);
  writer.put(static_cast<std::uint8_t>(name));
  writer.put(header.baud);
  writer.put(header.utc_ns);
  writer.put(header.monotonic_ns);
  for (std::size_t i = 0; i < name; ++i) writer.put(static_cast<std::uint8_t>(header.target[i]));
  writer.put(wire::crc32(std::span(out).first(out.size() - kCrcBytes)));
  return out;
}

void append_chunk(const StreamChunk& chunk, Bytes& out) {
  if (chunk.lost_before > 0) {
    std::array<std::uint8_t, 8> lost{};
    wire::ByteWriter(lost).put(chunk.lost_before);
    append_one(kLossMark, chunk, lost, out);
  }
  append_one(kDataMark, chunk, chunk.bytes.first(std::min(chunk.bytes.size(), kMaxChunkBytes)), out);
}

}  // namespace pharos::host::stream_format
