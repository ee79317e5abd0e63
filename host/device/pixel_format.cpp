// SPDX-License-Identifier: Apache-2.0
#include "host/device/pixel_format.hpp"

#include <bit>
#include <cstring>

namespace pharos::host {
namespace {

constexpr std::size_t kBytesAbcy16 = 8;
constexpr std::size_t kBytes16 = 2;
constexpr std::size_t kZ = 2;  // index in X, Y, Z, intensity
constexpr std::size_t kIntensityPlace = 3;

std::uint16_t little_endian(const std::uint8_t* bytes) {
  if constexpr (std::endian::native == std::endian::little) {
    std::uint16_t value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}

}  // namespace

bool unpack_abcy16(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> depth,
                   std::span<std::uint16_t> intensity) {
  if (depth.size() != intensity.size() || bytes.size() != kBytesAbcy16 * depth.size()) return false;
  const std::uint8_t* pixel = bytes.data();
  for (std::size_t i = 0; i < depth.size(); ++i, pixel += kBytesAbcy16) {
    depth[i] = little_endian(pixel + kBytes16 * kZ);
    intensity[i] = little_endian(pixel + kBytes16 * kIntensityPlace);
  }
  return true;
}

bool unpack_16(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> values) {
  if (bytes.size() != kBytes16 * values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = little_endian(bytes.data() + kBytes16 * i);
  return true;
}

bool unpack_8(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> values) {
  constexpr unsigned kWhite16PerWhite8 = 257;
  if (bytes.size() != values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(kWhite16PerWhite8 * bytes[i]);
  return true;
}

}  // namespace pharos::host
