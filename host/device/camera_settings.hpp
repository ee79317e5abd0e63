// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pharos::host {

/// What the camera is to send.
enum class CameraFormat : std::uint8_t {
  kDepth,   // Coord3D_ABCY16, else Coord3D_C16 and Mono16 in turns: a depth camera
  kMono8,   // grey
  kMono16,  // grey
};

/// Which GigE Vision camera, and how it is to be set.
struct CameraSettings {
  /// Found by its serial number, or by its IP address where that is given; of both, the camera at the address must
  /// have the serial number.
  std::string serial;
  std::string address;
  /// Scan3dOperatingMode; empty: as the camera has it.
  std::string mode;
  CameraFormat format = CameraFormat::kDepth;
  /// Bytes of a packet with its headers. More than 1500 needs jumbo frames on every hop.
  int packet_size = 1400;
  /// Frames a second; 0: as the camera has it.
  double frame_rate_hz = 0.0;
  /// Let the camera follow the network's PTP clock where it can.
  bool ptp = true;
  /// What the camera must give: that of the camera file.
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
};

}  // namespace pharos::host
