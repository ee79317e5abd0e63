// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_ootx_fields.hpp"

#include <cmath>

namespace pharos::lighthouse {
namespace {

constexpr std::size_t kKnownBytes = 41;
constexpr std::uint8_t kLastProtocolOfLh1 = 6;

bool all_finite(const PlaneCalibration& plane) {
  return std::isfinite(plane.phase_rad) && std::isfinite(plane.tilt_rad) && std::isfinite(plane.curve) &&
         std::isfinite(plane.gibbous_phase_rad) && std::isfinite(plane.gibbous_magnitude_rad) &&
         std::isfinite(plane.ogee_phase_rad) && std::isfinite(plane.ogee_magnitude);
}

}  // namespace

Result<Lh2OotxFields, OotxError> lh2_ootx_fields(std::span<const std::uint8_t> payload) {
  if (payload.size() < 2) return OotxError::kTooShort;
  Lh2OotxFields fields;
  const std::uint16_t version = ootx_word(payload, 0x00);
  fields.firmware = static_cast<std::uint16_t>(version >> 6U);
  fields.protocol = static_cast<std::uint8_t>(version & 0x3FU);
  if (fields.protocol <= kLastProtocolOfLh1) return OotxError::kUnknownProtocol;
  if (payload.size() < kKnownBytes) return OotxError::kTooShort;
  fields.calibration.id = ootx_word(payload, 0x02) | std::uint32_t{ootx_word(payload, 0x04)} << 16U;
  for (std::size_t k = 0; k < kPlanes; ++k) {
    PlaneCalibration& plane = fields.calibration.plane[k];
    plane.phase_rad = ootx_half(payload, 0x06 + 2 * k);
    plane.tilt_rad = ootx_half(payload, 0x0A + 2 * k);
    plane.curve = ootx_half(payload, 0x10 + 2 * k);
    plane.gibbous_phase_rad = ootx_half(payload, 0x17 + 2 * k);
    plane.gibbous_magnitude_rad = ootx_half(payload, 0x1B + 2 * k);
    plane.ogee_phase_rad = ootx_half(payload, 0x21 + 2 * k);
    plane.ogee_magnitude = ootx_half(payload, 0x25 + 2 * k);
    if (!all_finite(plane)) return OotxError::kNotFinite;
  }
  fields.unlock_count = payload[0x0E];
  fields.hardware = payload[0x0F];
  for (std::size_t i = 0; i < fields.acceleration.size(); ++i) {
    fields.acceleration[i] = static_cast<std::int8_t>(payload[0x14 + i]);
  }
  fields.mode = payload[0x1F];
  fields.faults = payload[0x20];
  return fields;
}

}  // namespace pharos::lighthouse
