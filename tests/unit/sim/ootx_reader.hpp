// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace pharos::sim {

inline std::string to_hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    char hex[3];
    std::snprintf(hex, sizeof hex, "%02x", byte);
    text += hex;
  }
  return text;
}

/// Payloads (hex) of every frame with a good CRC in a run of bits without gaps. The CRC is zlib's.
inline std::vector<std::string> read_ootx(const std::vector<bool>& bits) {
  std::vector<std::string> payloads;
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (!bits[i]) {
      ++zeros;
      continue;
    }
    const bool preamble = zeros >= 17;
    zeros = 0;
    if (!preamble) continue;
    std::vector<std::uint8_t> bytes;
    for (std::size_t at = i + 1; at + 16 < bits.size() && bits[at + 16]; at += 17) {
      for (std::size_t byte = 0; byte < 2; ++byte) {
        unsigned value = 0;
        for (std::size_t bit = 0; bit < 8; ++bit) value = value << 1 | (bits[at + 8 * byte + bit] ? 1u : 0u);
        bytes.push_back(static_cast<std::uint8_t>(value));
      }
    }
    if (bytes.size() < 2) continue;
    const std::size_t length = bytes[0] | static_cast<std::size_t>(bytes[1]) << 8;
    const std::size_t crc_at = 2 + length + length % 2;
    if (length > 255 || bytes.size() < crc_at + 4) continue;
    std::uint32_t crc = 0;
    for (std::size_t k = 0; k < 4; ++k) crc |= static_cast<std::uint32_t>(bytes[crc_at + k]) << (8 * k);
    if (crc != crc32(0, bytes.data() + 2, static_cast<uInt>(length))) continue;
    payloads.push_back(to_hex({bytes.begin() + 2, bytes.begin() + 2 + static_cast<std::ptrdiff_t>(length)}));
  }
  return payloads;
}

}  // namespace pharos::sim
