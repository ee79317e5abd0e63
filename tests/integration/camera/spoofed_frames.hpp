// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/camera/frame_sequence.hpp"

namespace pharos::host {

/// Header values of a spoofed frame.
struct SpoofedHead {
  std::uint16_t number = 1;
  std::int64_t camera_ns = 0;
};

/// A depth camera's frames as of the simulated Helios, with the view shifted to the side by `shift_px`: complete and
/// valid, but with a target at another position.
class SpoofedFrames {
 public:
  SpoofedFrames(const sim::FrameSequence& sequence, const sim::WireScale& scale, std::int32_t shift_px,
                std::size_t packet_size);
  /// Sends all packets of a frame from `socket` to `port` of 127.0.0.1.
  void send(int socket, std::uint16_t port, const SpoofedHead& head) const;

 private:
  std::vector<std::uint8_t> payload_;
  std::int32_t width_px_;
  std::int32_t height_px_;
  std::size_t block_bytes_;
};

}  // namespace pharos::host
