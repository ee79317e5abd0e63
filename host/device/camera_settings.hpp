// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pharos::host {

/// Format of the camera's frames.
enum class CameraFormat : std::uint8_t {
  kDepth,   // a depth camera: Coord3D_ABCY16, or Coord3D_C16 and Mono16 alternating
  kMono8,   // grey
  kMono16,  // grey
};

/// A GigE Vision camera and its settings.
struct CameraSettings {
  /// It is found by its IP address if given, otherwise by its serial number. With both, the camera at the address must
  /// have the serial number.
  std::string serial;
  std::string address;
  /// Scan3dOperatingMode; empty: not changed.
  std::string mode;
  CameraFormat format = CameraFormat::kDepth;
  /// Size of a packet with its headers, bytes. More than 1500 needs jumbo frames on every hop.
  int packet_size = 1400;
  /// Frames per second; 0: not changed.
  double frame_rate_hz = 0.0;
  /// Synchronise the camera by PTP if it supports it.
  bool ptp = true;
  /// Required size of the camera's frames: that of the camera file.
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
};

}  // namespace pharos::host
