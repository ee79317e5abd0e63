// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::sim {

/// One frame that the camera will show, and what is true in it.
struct SequenceFrame {
  std::vector<std::uint16_t> intensity;  // row by row
  std::vector<std::uint16_t> depth;      // counts of FrameSequence::depth_scale_m; 0 and 65535: none; empty: grey alone
  std::optional<Pose<frame::Camera, frame::Target>> T_camera_target;
};

/// Frames made beforehand: the camera's thread has no time to make them. Shown forwards, then backwards, and so on, so
/// that nothing jumps.
struct FrameSequence {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double depth_scale_m = 0.00025;
  /// Where every pixel looks: x/z, y/z, row by row; empty where only Z and intensity matter.
  std::vector<std::array<float, 2>> rays;
  std::vector<SequenceFrame> frames;

  /// The frame to show as the `number`-th, from 0.
  const SequenceFrame& at(std::uint64_t number) const {
    const std::size_t count = frames.size();
    if (count == 1) return frames.front();
    const std::size_t place = static_cast<std::size_t>(number % (2 * count - 2));
    return frames[place < count ? place : 2 * count - 2 - place];
  }
};

/// How metres become counts on the wire: count = (m - offset) / scale, for X, Y, Z.
struct WireScale {
  std::array<double, 3> scale_m{0.00025, 0.00025, 0.00025};
  std::array<double, 3> offset_m{-8.192, -8.192, 0.0};
};

/// The frame as the camera sends it in this pixel format (host/device/pixel_format.hpp); zeros for a format that it
/// has not. `out` is the payload: as many bytes as format and size ask for.
void write_payload(const FrameSequence& sequence, const SequenceFrame& frame, std::uint32_t format,
                   const WireScale& wire, std::span<std::uint8_t> out);

}  // namespace pharos::sim
