// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace pharos::wire {

/// CRC-32 as in zlib, Ethernet and PNG (reflected polynomial 0xEDB88320, start and final xor 0xFFFFFFFF): "123456789"
/// gives 0xCBF43926. `so_far`: the CRC of the bytes before these, to continue from. Two table look-ups a byte; the
/// table has 64 bytes, to save the target's memory.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t so_far = 0);

}  // namespace pharos::wire
