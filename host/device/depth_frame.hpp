// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pharos/base/image_view.hpp"

namespace pharos::host {

/// Conversion of counts of X, Y, Z to metres, as stated by the camera: m = count * scale + offset.
struct CoordinateScale {
  std::array<double, 3> scale_m{};
  std::array<double, 3> offset_m{};
};

/// Epoch of a frame's time.
enum class CameraClock : std::uint8_t {
  kOwn,   // the camera's own, arbitrary
  kPtp,   // the epoch of 1970, UTC or TAI, as of the network's PTP clock
  kHost,  // the epoch of 1970, UTC of this computer
};

/// One frame of a depth camera: intensity and Cartesian Z of every pixel, and its time. Of a grey camera: intensity
/// only.
struct DepthFrame {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::uint16_t> intensity;  // row by row
  std::vector<std::uint16_t> depth;      // counts; 0 and 65535: none
  /// Number of times the camera had been opened; its clock and its frame numbers restart at every opening.
  std::uint32_t session = 0;
  /// Time of exposure, ns on this clock.
  std::int64_t camera_ns = 0;
  CameraClock clock = CameraClock::kOwn;
  /// Depth and intensity are from consecutive frames (alternating formats): camera_ns is that of the depth.
  bool taken_in_turns = false;
  /// Arrival of the first packet, and of the complete frame, on this computer's clocks.
  std::int64_t arrival_utc_ns = 0;
  std::int64_t arrival_monotonic_ns = 0;
  std::int64_t complete_monotonic_ns = 0;
  /// From the camera's nodes; empty if it has none (the camera file's is used then).
  std::optional<CoordinateScale> scale;

  void resize(std::int32_t width, std::int32_t height) {
    width_px = width;
    height_px = height;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    intensity.resize(pixels);
    depth.resize(pixels);
  }
  void resize_grey(std::int32_t width, std::int32_t height) {
    resize(width, height);
    depth.clear();
  }
  ImageView<const std::uint16_t> intensity_view() const { return {intensity.data(), width_px, height_px}; }
  ImageView<const std::uint16_t> depth_view() const { return {depth.data(), width_px, height_px}; }
};

using DepthFramePtr = std::unique_ptr<DepthFrame>;

}  // namespace pharos::host
