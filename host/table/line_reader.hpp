// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "host/table/byte_source.hpp"

namespace pharos::host {

/// What to do with a last line that has no line end.
enum class LastLine {
  kAccept,          // tables written by hand: some editors omit it
  kDropUnfinished,  // recordings: the line was cut off while being written, its last number may be incomplete
};

/// Lines of a ByteSource without their ends (LF or CRLF); blank lines are skipped and counted. About 1 GB/s.
class LineReader {
 public:
  LineReader(ByteSource source, LastLine last_line);

  /// The next line, valid until the next call; empty at the end. Throws InputError on a line longer than 64 KiB (not a
  /// table) or one with a zero byte (binary data).
  std::optional<std::string_view> next();
  /// Number of the line last returned, counted from 1.
  std::size_t line_number() const { return line_number_; }
  /// An unfinished last line was dropped, or the gzip data was cut off.
  bool ended_unfinished() const { return ended_unfinished_ || source_.cut_off(); }
  const std::string& name() const { return source_.name(); }

 private:
  std::optional<std::string_view> next_raw();
  bool fill();
  [[noreturn]] void refuse(const char* why) const;

  ByteSource source_;
  LastLine last_line_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t scanned_ = 0;
  std::size_t end_ = 0;
  std::size_t line_number_ = 0;
  bool ended_unfinished_ = false;
};

}  // namespace pharos::host
