// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pharos/wire/frame.hpp"
#include "pharos/wire/link_counters.hpp"

namespace pharos::wire {

/// Finds frames in a stream of bytes with any content in between, and counts all that it drops by cause.
///
/// Every zero byte is a frame border, so errors of any kind cost the frames they hit and no other. A frame is returned
/// only when its stuffing, length, CRC-32 and version are right. Frames of other protocol versions are reported by
/// unsupported_version(); unknown types are skipped. State: about 650 bytes. Cost: one buffer store a byte, and the
/// CRC.
class FrameDecoder {
 public:
  /// The frame that `byte` completed, if any. Its payload points into this object and is valid until the next push.
  std::optional<Frame> push(std::uint8_t byte);
  /// Restarts at the next byte (the line was unplugged): a partial frame is dropped. Counters stay.
  void restart();
  /// A good frame had an invalid payload; called by the decoder of payloads.
  void count_bad_payload() { ++counters_.bad_payload; }

  const LinkCounters& counters() const { return counters_; }
  /// Protocol version of the last frame of another version that came with a good CRC.
  std::optional<std::uint8_t> unsupported_version() const { return unsupported_version_; }

 private:
  std::optional<Frame> finish_frame();
  std::optional<Frame> check_frame(std::size_t size, std::size_t bytes_on_line);
  bool check_sequence(const Frame& frame, std::uint32_t crc);
  void drop(std::uint64_t& cause, std::size_t bytes_on_line);

  LinkCounters counters_;
  std::array<std::uint8_t, stuffed_size(kMaxFrame)> buffer_{};
  std::size_t size_ = 0;   // stuffed bytes since the last border; more than the buffer holds means too long
  bool mid_frame_ = true;  // no border seen yet: the first bytes may be the rest of a frame
  bool any_frame_ = false;
  bool reopened_ = false;  // no frame since restart()
  std::uint16_t last_sequence_ = 0;
  std::uint32_t last_crc_ = 0;
  std::optional<std::uint8_t> unsupported_version_;
};

}  // namespace pharos::wire
