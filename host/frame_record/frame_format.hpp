// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/camera_link/camera_message.hpp"

namespace pharos::host {

/// Head of a file of recorded frames.
struct FramesHeader {
  std::string camera;  // name in the configuration (of a rig NAME-left, NAME-right), at most 255 bytes
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  bool has_depth = false;
  std::int64_t utc_ns = 0;        // when the file was begun
  std::int64_t monotonic_ns = 0;  // the same instant on the recording computer's monotonic clock

  std::size_t pixel_bytes() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * (has_depth ? 4 : 2);
  }
};

// The layout, little-endian (see README.md):
//   head:  magic 8, version u8, name length u8, has depth u8, width i32, height i32, utc i64, monotonic i64, name,
//   CRC-32 frame: mark u8, notice length u16, notice (camera_message's FrameNotice, with a CRC of its own), depth u16
//   and
//          intensity u16 of each pixel by rows, CRC-32 of the pixels
// A notice's sequence counts the frames that were to be recorded: a gap tells how many are missing.
namespace frame_format {

/// As PNG's: a byte above 127 and a line end reveal a file that was converted as text.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'P', 'H', 'C', 'A', 'M', '\r', '\n'};
inline constexpr std::uint8_t kVersion = 1;
inline constexpr std::size_t kHeadBytes = 35;  // without name and CRC
inline constexpr std::size_t kCrcBytes = 4;
inline constexpr std::uint8_t kFrameMark = 0xC7;
inline constexpr std::size_t kMarkBytes = 3;  // mark and length

std::vector<std::uint8_t> encode_head(const FramesHeader& header);
/// What precedes a frame's pixels.
std::vector<std::uint8_t> encode_notice(const FrameNotice& notice);

/// Size of the head that begins with these kHeadBytes bytes; 0 where they begin none of this version.
std::size_t head_bytes(std::span<const std::uint8_t> first);
/// Empty where the CRC is wrong, or sizes or times are impossible.
std::optional<FramesHeader> decode_head(std::span<const std::uint8_t> whole);

/// CRC-32 as in PNG and gzip (zlib's: a Helios' frame takes 1 ms).
std::uint32_t crc_of(std::span<const std::uint8_t> bytes, std::uint32_t so_far = 0);

}  // namespace frame_format
}  // namespace pharos::host
