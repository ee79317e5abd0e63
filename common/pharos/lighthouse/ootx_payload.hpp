// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::lighthouse {

/// Longest OOTX payload accepted: 33 bytes are known; the length field allows up to 65,535.
inline constexpr std::size_t kMaxOotxPayload = 64;

/// One OOTX frame whose CRC was good.
struct OotxPayload {
  std::int64_t time_ticks = 0;  // start of the flash that carried the last bit
  std::uint8_t station = 0;     // slot position, as in Flash
  StaticVector<std::uint8_t, kMaxOotxPayload> bytes;
};

/// The fields of a payload of protocol 4 to 6 (31 or 33 bytes).
struct OotxFields {
  std::uint16_t firmware = 0;
  std::uint8_t protocol = 0;
  StationCalibration calibration;
  std::uint8_t unlock_count = 0;
  std::uint8_t hardware = 0;
  std::array<std::int8_t, 3> acceleration{};
  std::uint8_t mode = 0;    // 0 = A, 1 = B, 2 = C
  std::uint8_t faults = 0;  // absent in 31-byte payloads
};

}  // namespace pharos::lighthouse
