// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/frame_record/frame_format.hpp"
#include "host/table/lookahead.hpp"

namespace pharos::host {

struct FrameReaderCounters {
  std::int64_t frames = 0;
  std::int64_t frames_missing = 0;   // gaps in the sequence: not recorded, or damaged here
  std::int64_t frames_bad_time = 0;  // before the last one's, or impossibly long after it
  std::uint64_t dropped_bytes = 0;   // of the file that belonged to no whole frame
};

/// A file of recorded frames, plain or gzip, frame by frame as they were received. Damage loses the frames that it
/// touches; a file that was cut off gives all frames before. Memory: two frames of the size in the head, once that many
/// bytes are there.
class FrameReader {
 public:
  /// Throws InputError when the input does not begin as a recording, or is of another version.
  explicit FrameReader(ByteSource source);

  /// Longest gap within a file: the recorder begins a new one after a week at the latest.
  static constexpr std::int64_t kLongestSilence_ns = 8 * std::int64_t{86'400} * 1'000'000'000;

  const FramesHeader& header() const { return header_; }
  /// The next frame into `frame`, whose buffers are used again; false at the end.
  bool next(DepthFrame& frame);
  /// After the end: the last frame was incomplete.
  bool cut_off() const { return cut_off_; }
  const FrameReaderCounters& counters() const { return counters_; }
  const std::string& name() const { return in_.name(); }

 private:
  std::optional<FrameNotice> notice_here();
  bool pixels_good(std::size_t head, std::size_t whole);
  bool credible(const DepthFrame& frame) const;
  void take_pixels(std::span<const std::uint8_t> pixels, const FrameNotice& notice, DepthFrame& frame) const;

  Lookahead in_;
  FramesHeader header_;
  FrameReaderCounters counters_;
  std::uint64_t last_sequence_ = 0;
  std::int64_t last_monotonic_ns_ = 0;
  bool cut_off_ = false;
};

}  // namespace pharos::host
