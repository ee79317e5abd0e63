// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/sim/laser_sheet.hpp"

namespace pharos::sim {

/// The values that a station announces; magnitudes are rounded to half precision.
struct StationAnnouncement {
  std::uint16_t firmware = 244;
  std::uint32_t id = 0;
  std::array<SheetErrors, 2> rotor;
  std::uint8_t unlock_count = 2;
  std::uint8_t hardware = 9;
  std::array<std::int8_t, 3> acceleration{-1, 127, 9};
  std::uint8_t mode = 0;  // 0 = A, 1 = B, 2 = C
  std::uint8_t faults = 0;
};

/// The nearest IEEE half-precision value (ties to even): its bits and its value.
std::uint16_t to_half(double value);
double from_half(std::uint16_t half);

/// The errors after a transmission in half precision.
SheetErrors as_transmitted(const SheetErrors& errors);

/// The 33 bytes of protocol 6.
std::vector<std::uint8_t> announcement_bytes(const StationAnnouncement& announcement);

/// One frame as transmitted by flashes: preamble (17 zeros, a one), length, payload padded to even, CRC-32, a one after
/// every 16 bits.
std::vector<bool> ootx_frame_bits(const std::vector<std::uint8_t>& payload);

/// CRC-32 (reflected, polynomial 0x04C11DB7) of the bytes.
std::uint32_t frame_checksum(const std::vector<std::uint8_t>& bytes);

}  // namespace pharos::sim
