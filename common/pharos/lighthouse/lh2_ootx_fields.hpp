// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/lighthouse/lh2_model.hpp"
#include "pharos/lighthouse/ootx_fields.hpp"

namespace pharos::lighthouse {

/// The fields of a payload of Lighthouse 2.0 (43 bytes; the last two are not known).
struct Lh2OotxFields {
  std::uint16_t firmware = 0;
  std::uint8_t protocol = 0;
  Lh2Calibration calibration;
  std::uint8_t unlock_count = 0;
  std::uint8_t hardware = 0;
  std::array<std::int8_t, 3> acceleration{};
  std::uint8_t mode = 0;  // its low four bits are the channel
  std::uint8_t faults = 0;
};

/// Fields as Lighthouse 1.0 has them, and two more a plane. kUnknownProtocol: 6 or below (stations in use send 8).
Result<Lh2OotxFields, OotxError> lh2_ootx_fields(std::span<const std::uint8_t> payload);

}  // namespace pharos::lighthouse
