// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pharos/base/image_view.hpp"

namespace pharos::host {

/// How counts of X, Y, Z become metres, as the camera itself says: m = count * scale + offset.
struct CoordinateScale {
  std::array<double, 3> scale_m{};
  std::array<double, 3> offset_m{};
};

/// What a frame's time counts from.
enum class CameraClock : std::uint8_t {
  kOwn,   // whatever the camera's clock began at
  kPtp,   // the epoch of 1970, UTC or TAI, as the network's PTP clock has it
  kHost,  // the epoch of 1970, UTC of this computer
};

/// One frame of a depth camera: intensity and Cartesian Z of every pixel, and when it was taken. Of a grey camera: the
/// intensity alone.
struct DepthFrame {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::uint16_t> intensity;  // row by row
  std::vector<std::uint16_t> depth;      // counts; 0 and 65535: none
  /// How often the camera had been opened when it sent this; its clock and its numbers begin anew with every opening.
  std::uint32_t session = 0;
  /// When it was taken, ns on this clock.
  std::int64_t camera_ns = 0;
  CameraClock clock = CameraClock::kOwn;
  /// Depth and intensity were taken one after the other (formats that hold one of them): camera_ns is of the depth.
  bool taken_in_turns = false;
  /// First packet's arrival on this computer's clocks, and the whole frame's.
  std::int64_t arrival_utc_ns = 0;
  std::int64_t arrival_monotonic_ns = 0;
  std::int64_t complete_monotonic_ns = 0;
  /// Of the camera's nodes; empty where it has none (then the camera file holds).
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
