// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pharos/wire/frame.hpp"
#include "pharos/wire/link_counters.hpp"

namespace pharos::wire {

/// Finds frames in a stream of bytes, whatever comes in between, and counts all that it drops by cause.
///
/// Every zero byte is a frame border, so garbage of any kind costs the frames it hits and no other. A frame is given
/// out only when its stuffing, length, CRC-32 and version are right. Frames of other protocol versions are told by
/// unsupported_version(); unknown types are skipped. State: about 650 bytes. Cost: one buffer store a byte, and the
/// CRC.
class FrameDecoder {
 public:
  /// The frame that `byte` completed, if any. Its payload points into this object and holds until the next push.
  std::optional<Frame> push(std::uint8_t byte);
  /// Begins anew at the next byte (the line was unplugged): a frame cut in the middle is dropped. Counters stay.
  void restart();
  /// A good frame turned out to carry a payload that means nothing; for whoever decodes payloads.
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
