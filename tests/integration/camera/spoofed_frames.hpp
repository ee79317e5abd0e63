// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/camera/frame_sequence.hpp"

namespace pharos::host {

/// What a spoofed frame says of itself.
struct SpoofedHead {
  std::uint16_t number = 1;
  std::int64_t camera_ns = 0;
};

/// A depth camera's frames as the simulated Helios would send them, the view shifted to the side by `shift_px`: whole
/// and in every way right, but of a target that is elsewhere.
class SpoofedFrames {
 public:
  SpoofedFrames(const sim::FrameSequence& sequence, const sim::WireScale& scale, std::int32_t shift_px,
                std::size_t packet_size);
  /// All packets of one, from `socket` to `port` of 127.0.0.1.
  void send(int socket, std::uint16_t port, const SpoofedHead& head) const;

 private:
  std::vector<std::uint8_t> payload_;
  std::int32_t width_px_;
  std::int32_t height_px_;
  std::size_t block_bytes_;
};

}  // namespace pharos::host
