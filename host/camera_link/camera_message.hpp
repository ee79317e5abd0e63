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
#include "host/device/ptp_state.hpp"

namespace pharos::host {

/// Maximum size of a message. The largest is a report with both texts of maximum length, about 2.2 kB.
inline constexpr std::size_t kMaxCameraMessage_bytes = 4096;
/// Maximum length of each text in a message; longer texts are truncated.
inline constexpr std::size_t kMaxCameraText_bytes = 1024;

/// From pharosd to the camera's process, once, at its start.
struct CameraOrder {
  std::int32_t parent_pid = 0;  // the camera's process ends with this one
  CameraSettings settings;
};

/// A complete frame is in the shared memory. `about` holds everything but the pixels (its images are empty).
struct FrameNotice {
  std::uint64_t sequence = 0;  // 1, 2, 3... of this process; decides the slot
  bool has_depth = false;      // frames of a grey camera have intensity only
  DepthFrame about;
};

/// State of the camera: sent at every change, and ten times a second while counters change.
struct CameraReport {
  CameraState state = CameraState::kGone;
  std::uint32_t session = 0;
  FrameSourceCounters counters;  // of this process
  std::string identity;
  std::string error;
  PtpState ptp = PtpState::kOff;
  bool ptp_lost = false;  // it followed PTP before in this session, and does not now
};

/// The last message of a library that aborted the camera's process.
struct LastWords {
  std::string text;
};

using CameraMessage = std::variant<CameraOrder, FrameNotice, CameraReport, LastWords>;

/// One datagram of the socket between pharosd and a camera's process: little-endian fields
///
///   magic u32 "PHCM", version u16, kind u16, CRC-32 of what follows u32, then the fields of that kind
std::vector<std::uint8_t> encode(const CameraMessage& message);

/// Decodes any bytes. Empty for a wrong magic, version, length or CRC, an impossible state, size, time or scale, or a
/// text with characters other than printable ASCII. Sizes in a CameraOrder and a FrameNotice are positive and at most
/// kMaxFrameSide_px; the caller checks that they are the camera's.
std::optional<CameraMessage> decode_camera_message(std::span<const std::uint8_t> bytes);

/// Maximum width and height: no GigE Vision camera has more, and width * height * 8 bytes stay below 2^31.
inline constexpr std::int32_t kMaxFrameSide_px = 16'384;

}  // namespace pharos::host
