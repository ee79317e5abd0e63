// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/record/stream_format.hpp"
#include "host/table/lookahead.hpp"

namespace pharos::host {

/// A recorded serial stream, plain or gzip, chunk by chunk as received. Its bytes are input of report::LinkDecoder.
///
/// Damage loses only the chunks that it affects; dropped_bytes() counts it. A recording cut off in the middle of a
/// chunk (power lost, disk full) gives all chunks before and reports it. Times are checked: a chunk whose monotonic
/// time is before the last one's or more than kLongestSilence_ns after it, or whose clocks show no time of this
/// century, counts as lost.
class StreamReader {
 public:
  /// Throws InputError when the input does not begin as a recording, or is of a newer format.
  explicit StreamReader(ByteSource source);

  /// Longest gap within a file: the recorder begins a new one after a week at the latest.
  static constexpr std::int64_t kLongestSilence_ns = 8 * std::int64_t{86'400} * 1'000'000'000;

  const StreamHeader& header() const { return header_; }
  /// The next chunk; its bytes are valid until the next call. Empty at the end.
  std::optional<StreamChunk> next();
  /// After the end: the last chunk was incomplete.
  bool cut_off() const { return cut_off_; }
  /// Bytes of the file that belonged to no complete chunk.
  std::uint64_t dropped_bytes() const { return dropped_bytes_; }
  /// Chunks dropped because of their times.
  std::uint64_t bad_times() const { return bad_times_; }
  /// Bytes of the stream that the recorder marked as lost.
  std::uint64_t lost_bytes() const { return lost_bytes_; }
  const std::string& name() const { return in_.name(); }

  /// Whether the first bytes of an input are the signature of a recording.
  static bool looks_like(std::string_view first_bytes);
  /// Bytes that looks_like needs.
  static constexpr std::size_t kHeaderBytes = stream_format::kMagic.size();

 private:
  std::size_t whole_chunk_size();
  void read_header();
  bool credible(const StreamChunk& chunk) const;

  Lookahead in_;
  StreamHeader header_;
  bool cut_off_ = false;
  std::uint64_t dropped_bytes_ = 0;
  std::uint64_t lost_bytes_ = 0;
  std::uint64_t bad_times_ = 0;
  std::int64_t last_monotonic_ns_ = 0;  // of the last chunk returned, at first of the head
};

}  // namespace pharos::host
