// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ootx_sender.hpp"

#include <cmath>
#include <cstddef>

namespace pharos::sim {
namespace {

constexpr std::uint8_t kProtocol = 6;

void put16(std::vector<std::uint8_t>& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFu));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

void put32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  put16(bytes, static_cast<std::uint16_t>(value & 0xFFFFu));
  put16(bytes, static_cast<std::uint16_t>(value >> 16));
}

}  // namespace

std::uint16_t to_half(double value) {
  const std::uint16_t sign = std::signbit(value) ? 0x8000u : 0u;
  const double magnitude = std::abs(value);
  if (magnitude == 0.0) return sign;
  int exponent = 0;
  std::frexp(magnitude, &exponent);  // magnitude = m 2^exponent, m in [0.5, 1)
  exponent = exponent < -13 ? -13 : exponent;
  // In units of the last of 11 bits; nearbyint rounds ties to even.
  auto mantissa = static_cast<int>(std::nearbyint(std::ldexp(magnitude, 11 - exponent)));
  if (mantissa == 2048) {
    mantissa = 1024;
    ++exponent;
  }
  if (exponent > 16) return static_cast<std::uint16_t>(sign | 0x7C00u);
  if (mantissa < 1024) return static_cast<std::uint16_t>(sign | static_cast<unsigned>(mantissa));
  return static_cast<std::uint16_t>(sign | static_cast<unsigned>((exponent + 14) << 10) |
                                    static_cast<unsigned>(mantissa - 1024));
}

double from_half(std::uint16_t half) {
  const int exponent = (half >> 10) & 0x1F;
  const int fraction = half & 0x3FF;
  const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (half & 0x8000u) != 0 ? -magnitude : magnitude;
}

SheetErrors as_transmitted(const SheetErrors& errors) {
  const auto round = [](double value) { return from_half(to_half(value)); };
  return {round(errors.phase_rad), round(errors.tilt_rad), round(errors.curve_rad), round(errors.gibbous_phase_rad),
          round(errors.gibbous_magnitude_rad)};
}

std::vector<std::uint8_t> announcement_bytes(const StationAnnouncement& a) {
  std::vector<std::uint8_t> bytes;
  const auto both = [&](double SheetErrors::*field) {
    for (const SheetErrors& errors : a.rotor) put16(bytes, to_half(errors.*field));
  };
  put16(bytes, static_cast<std::uint16_t>(a.firmware << 6 | kProtocol));
  put32(bytes, a.id);
  both(&SheetErrors::phase_rad);
  both(&SheetErrors::tilt_rad);
  bytes.push_back(a.unlock_count);
  bytes.push_back(a.hardware);
  both(&SheetErrors::curve_rad);
  for (const std::int8_t value : a.acceleration) bytes.push_back(static_cast<std::uint8_t>(value));
  both(&SheetErrors::gibbous_phase_rad);
  both(&SheetErrors::gibbous_magnitude_rad);
  bytes.push_back(a.mode);
  bytes.push_back(a.faults);
  return bytes;
}

std::uint32_t frame_checksum(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

std::vector<bool> ootx_frame_bits(const std::vector<std::uint8_t>& payload) {
  std::vector<std::uint8_t> bytes;
  put16(bytes, static_cast<std::uint16_t>(payload.size()));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  if (payload.size() % 2 != 0) bytes.push_back(0);
  put32(bytes, frame_checksum(payload));

  std::vector<bool> bits(17, false);
  bits.push_back(true);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 7; bit >= 0; --bit) bits.push_back(((bytes[i] >> bit) & 1) != 0);
    if (i % 2 == 1) bits.push_back(true);
  }
  return bits;
}

}  // namespace pharos::sim
