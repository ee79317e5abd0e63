// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace pharos::host {

// GenICam pixel formats, as 32 bits. Bits 16-23 are the bits of a pixel.
inline constexpr std::uint32_t kCoord3dAbcy16 = 0x82400403;  // LUCID's own: X, Y, Z, intensity
inline constexpr std::uint32_t kCoord3dC16 = 0x011000B8;     // Z
inline constexpr std::uint32_t kMono8 = 0x01080001;          // intensity
inline constexpr std::uint32_t kMono16 = 0x01100007;         // intensity

/// Bytes of a frame of this format, width and height.
constexpr std::size_t payload_bytes(std::uint32_t format, std::int32_t width_px, std::int32_t height_px) {
  return static_cast<std::size_t>((format >> 16) & 0xFF) / 8 * static_cast<std::size_t>(width_px) *
         static_cast<std::size_t>(height_px);
}

/// Extracts Z and intensity from X, Y, Z, intensity (little-endian, 8 bytes per pixel). False, and nothing is written,
/// if the number of bytes does not fit that of pixels. About 0.3 ms for 640 x 480.
bool unpack_abcy16(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> depth,
                   std::span<std::uint16_t> intensity);

/// One little-endian number per pixel; false as above.
bool unpack_16(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> values);

/// One byte per pixel, as 16 bits: times 257, so that white is 65535 too; false as above.
bool unpack_8(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> values);

}  // namespace pharos::host
