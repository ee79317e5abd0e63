// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/frame_encoder.hpp"

#include <array>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/cobs.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::wire {

std::size_t FrameEncoder::encode(MessageType type, std::span<const std::uint8_t> payload, std::span<std::uint8_t> out) {
  if (payload.size() > kMaxPayload || out.size() < 2) return 0;
  std::array<std::uint8_t, kHeaderBytes> header{};
  ByteWriter head(header);
  head.put(kProtocolVersion);
  head.put(static_cast<std::uint8_t>(type));
  head.put(next_sequence_);
  std::array<std::uint8_t, kCrcBytes> crc{};
  ByteWriter(crc).put(crc32(payload, crc32(header)));

  CobsWriter stuffed(out.subspan(1, out.size() - 2));
  stuffed.put(header);
  stuffed.put(payload);
  stuffed.put(crc);
  const std::size_t size = stuffed.finish();
  if (size == 0) return 0;
  out[0] = 0;
  out[1 + size] = 0;
  ++next_sequence_;
  return size + 2;
}

}  // namespace pharos::wire
