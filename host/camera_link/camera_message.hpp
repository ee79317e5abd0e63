// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "host/device/camera_settings.hpp"
#include "host/device/depth_frame.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// Bytes of a message at the most: a status with both texts at their longest, some 2.2 kB, and room.
inline constexpr std::size_t kMaxCameraMessage_bytes = 4096;
/// Of each text in a message; what is longer is cut.
inline constexpr std::size_t kMaxCameraText_bytes = 1024;

/// pharosd to the camera's process, once, at its start.
struct CameraOrder {
  std::int32_t parent_pid = 0;  // whoever dies takes the camera's process along
  CameraSettings settings;
};

/// A whole frame lies in the shared memory. The pixels stay there: `about` holds everything else (its images are
/// empty).
struct FrameNotice {
  std::uint64_t sequence = 0;  // 1, 2, 3... of this process; decides the slot
  bool has_depth = false;      // a grey camera's frame has intensity alone
  DepthFrame about;
};

/// How the camera fares: at every change, and ten times a second while counters change.
struct CameraReport {
  CameraState state = CameraState::kGone;
  std::uint32_t session = 0;
  FrameSourceCounters counters;  // of this process
  std::string identity;
  std::string error;
};

/// What a library of the camera's process said before it gave up.
struct LastWords {
  std::string text;
};

using CameraMessage = std::variant<CameraOrder, FrameNotice, CameraReport, LastWords>;

/// One datagram of the socket between pharosd and a camera's process: little-endian fields
///
///   magic u32 "PHCM", version u16, kind u16, CRC-32 of what follows u32, then the fields of that kind
std::vector<std::uint8_t> encode(const CameraMessage& message);

/// Any bytes to a message, or nothing: wrong magic, version, length or CRC, a state, size, time or scale that cannot
/// be, a text with other than printable ASCII. A CameraOrder's sizes and a FrameNotice's are positive and at most
/// kMaxFrameSide_px; whether they are the camera's, the caller knows.
std::optional<CameraMessage> decode_camera_message(std::span<const std::uint8_t> bytes);

/// Of an image: what GigE Vision cameras have, and width * height * 8 bytes stay below 2^31.
inline constexpr std::int32_t kMaxFrameSide_px = 16'384;

}  // namespace pharos::host
