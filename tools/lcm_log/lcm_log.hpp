// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/table/byte_source.hpp"

namespace pharos::tools {

/// One message of a log. The views hold until the next call of LcmLogReader::next.
struct LoggedMessage {
  std::int64_t utime_us = 0;  // of its arrival at the logger, microseconds since 1970
  std::string_view channel;
  std::string_view data;
};

/// What a log held beside its messages.
struct LcmLogCounters {
  std::int64_t messages = 0;
  std::int64_t damaged = 0;  // places where bytes were skipped until the next whole message
  std::int64_t bytes_skipped = 0;
  bool cut_off = false;  // the last message is not complete
};

/// Reads a log of lcm-logger or of `pharosd`: for each message, big-endian, the word 0xEDA1DA01, a number (8 bytes),
/// the time (8), the lengths of channel and data (4 each), channel, data.
///
/// Own code, because LCM's reader takes the first damaged byte for the end of the log. Here a message counts when the
/// word of the next one, or the end, follows it; otherwise the next such word is searched, and what was skipped is
/// counted. Reads `-`, and .gz. Memory: two messages.
class LcmLogReader {
 public:
  /// Longer channels (LCM's own limit) and longer data are damage.
  static constexpr std::size_t kMaxChannel = 63;
  static constexpr std::size_t kMaxData = std::size_t{64} << 20U;

  explicit LcmLogReader(host::ByteSource source) : source_(std::move(source)) {}
  /// Begins at a position() of before; the source is at its start. A log that is shorter has no message.
  LcmLogReader(host::ByteSource source, std::int64_t position);

  /// The next whole message; none at the end. Throws InputError where the file cannot be read.
  std::optional<LoggedMessage> next();
  /// Where the next message is looked for, in bytes (of the unpacked log) from its start.
  std::int64_t position() const { return dropped_ + static_cast<std::int64_t>(begin_); }
  const LcmLogCounters& counters() const { return counters_; }
  const std::string& name() const { return source_.name(); }

 private:
  struct Header;
  bool have(std::size_t count);
  std::optional<Header> header();
  std::optional<bool> whole(const Header& header);
  bool skip_to_next_word();
  void count_skipped(std::size_t count);
  void drop_used();

  host::ByteSource source_;
  std::string buffer_;
  std::size_t begin_ = 0;     // of what is not used yet
  std::int64_t dropped_ = 0;  // bytes of the log before the buffer
  bool ended_ = false;
  bool in_damage_ = false;
  LcmLogCounters counters_;
};

}  // namespace pharos::tools
