// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/ootx_fields.hpp"

#include <cmath>
#include <limits>

namespace pharos::lighthouse {
namespace {

constexpr std::size_t kShortPayload = 31;  // protocols 4 and 5: no faults byte
constexpr std::size_t kLongPayload = 33;   // protocol 6

bool finite(const RotorCalibration& rotor) {
  return std::isfinite(rotor.phase_rad) && std::isfinite(rotor.tilt_rad) && std::isfinite(rotor.curve_rad) &&
         std::isfinite(rotor.gibbous_phase_rad) && std::isfinite(rotor.gibbous_magnitude_rad);
}

}  // namespace

std::uint16_t ootx_word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}

double ootx_half(std::span<const std::uint8_t> bytes, std::size_t at) { return half_to_double(ootx_word(bytes, at)); }

double half_to_double(std::uint16_t half) {
  const double sign = (half & 0x8000U) != 0 ? -1.0 : 1.0;
  const int exponent = (half >> 10U) & 0x1F;
  const int fraction = half & 0x3FF;
  if (exponent == 0x1F) {
    return fraction == 0 ? sign * std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  if (exponent == 0) return sign * std::ldexp(static_cast<double>(fraction), -24);
  return sign * std::ldexp(static_cast<double>(0x400 + fraction), exponent - 25);
}

Result<OotxFields, OotxError> ootx_fields(std::span<const std::uint8_t> payload) {
  if (payload.size() < kShortPayload) return OotxError::kTooShort;
  OotxFields fields;
  const std::uint16_t version = ootx_word(payload, 0x00);
  fields.firmware = static_cast<std::uint16_t>(version >> 6U);
  fields.protocol = static_cast<std::uint8_t>(version & 0x3FU);
  if (fields.protocol < 4 || fields.protocol > 6) return OotxError::kUnknownProtocol;
  if (fields.protocol == 6 && payload.size() < kLongPayload) return OotxError::kTooShort;

  fields.calibration.id = ootx_word(payload, 0x02) | std::uint32_t{ootx_word(payload, 0x04)} << 16U;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    RotorCalibration& rotor = fields.calibration.rotor[axis];
    rotor.phase_rad = ootx_half(payload, 0x06 + 2 * axis);
    rotor.tilt_rad = ootx_half(payload, 0x0A + 2 * axis);
    rotor.curve_rad = ootx_half(payload, 0x10 + 2 * axis);
    rotor.gibbous_phase_rad = ootx_half(payload, 0x17 + 2 * axis);
    rotor.gibbous_magnitude_rad = ootx_half(payload, 0x1B + 2 * axis);
    if (!finite(rotor)) return OotxError::kNotFinite;
  }
  fields.unlock_count = payload[0x0E];
  fields.hardware = payload[0x0F];
  for (std::size_t i = 0; i < fields.acceleration.size(); ++i) {
    fields.acceleration[i] = static_cast<std::int8_t>(payload[0x14 + i]);
  }
  if (payload.size() > 0x1F) fields.mode = payload[0x1F];
  if (payload.size() > 0x20) fields.faults = payload[0x20];
  return fields;
}

}  // namespace pharos::lighthouse
