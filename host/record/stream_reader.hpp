// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/record/stream_format.hpp"
#include "host/table/byte_source.hpp"

namespace pharos::host {

/// A recorded serial stream, plain or gzip, chunk by chunk as it arrived. Feed the bytes to report::LinkDecoder.
///
/// Damage costs the chunks that it hits and no other; dropped_bytes() counts it. A recording cut off in the middle of a
/// chunk (power lost, disk full) gives all before and says so. Times are believed within bounds: a chunk whose
/// monotonic time lies before the last one's or more than kLongestSilence_ns after it, or whose clocks show no time of
/// this century, counts as lost.
class StreamReader {
 public:
  /// Throws InputError when the input does not begin as a recording, or is of a newer format.
  explicit StreamReader(ByteSource source);

  /// No recorder leaves a longer hole in a file: a new one begins after a week at the latest.
  static constexpr std::int64_t kLongestSilence_ns = 8 * std::int64_t{86'400} * 1'000'000'000;

  const StreamHeader& header() const { return header_; }
  /// The next chunk; its bytes hold until the next call. Empty at the end.
  std::optional<StreamChunk> next();
  /// After the end: the last chunk was not whole.
  bool cut_off() const { return cut_off_; }
  /// Bytes of the file that belonged to no whole chunk.
  std::uint64_t dropped_bytes() const { return dropped_bytes_; }
  /// Chunks dropped because of their times.
  std::uint64_t bad_times() const { return bad_times_; }
  /// Bytes of the stream that the recorder itself said it lost.
  std::uint64_t lost_bytes() const { return lost_bytes_; }
  const std::string& name() const { return source_.name(); }

  /// Whether the first bytes of an input are those of such a recording.
  static bool looks_like(std::string_view first_bytes);
  /// Bytes that looks_like needs.
  static constexpr std::size_t kHeaderBytes = stream_format::kMagic.size();

 private:
  bool fill(std::size_t count);
  std::span<const std::uint8_t> ahead(std::size_t count) const;
  std::size_t whole_chunk_size();
  void read_header();
  bool credible(const StreamChunk& chunk) const;

  ByteSource source_;
  StreamHeader header_;
  std::vector<std::uint8_t> buffer_;  // [at_, end): read and not yet used
  std::size_t at_ = 0;
  bool ended_ = false;
  bool cut_off_ = false;
  std::uint64_t dropped_bytes_ = 0;
  std::uint64_t lost_bytes_ = 0;
  std::uint64_t bad_times_ = 0;
  std::int64_t last_monotonic_ns_ = 0;  // of the last chunk given out, at first of the head
};

}  // namespace pharos::host
