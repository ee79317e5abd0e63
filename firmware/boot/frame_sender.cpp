// SPDX-License-Identifier: Apache-2.0
#include "firmware/boot/frame_sender.hpp"

#include <cstring>

#include "pharos/wire/crc32.hpp"

namespace pharos::boot {

std::span<const std::uint8_t> FrameSender::encode(wire::MessageType type, std::span<const std::uint8_t> payload) {
  auto* const bytes = reinterpret_cast<std::uint8_t*>(&line_);
  line_.version = wire::kProtocolVersion;
  line_.type = static_cast<std::uint8_t>(type);
  line_.sequence = next_sequence_++;
  std::memcpy(line_.rest.data(), payload.data(), payload.size());
  const std::uint32_t crc = wire::crc32({&line_.version, wire::kHeaderBytes + payload.size()});
  std::memcpy(line_.rest.data() + payload.size(), &crc, sizeof crc);
  // Stuffing in place (wire/cobs.hpp): each zero becomes the distance to the next one.
  const std::size_t end = offsetof(Line, rest) + payload.size() + sizeof crc;
  bytes[end] = wire::kFrameDelimiter;
  std::size_t code_at = offsetof(Line, code);
  for (std::size_t at = offsetof(Line, version); at <= end; ++at) {
    if (bytes[at] != 0) continue;
    bytes[code_at] = static_cast<std::uint8_t>(at - code_at);
    code_at = at;
  }
  return {bytes, end + 1};
}

}  // namespace pharos::boot
