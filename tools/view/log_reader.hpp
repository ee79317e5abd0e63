// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pharos::tools {

/// One message of a log.
struct LogMessage {
  std::int64_t utime_us = 0;  // of its arrival, since 1970-01-01 UTC
  std::string channel;
  std::vector<unsigned char> bytes;
};

/// A log of lcm-logger (or of an LCM `file:` URL), message by message. Broken pieces are skipped up to the next message
/// and counted; LCM's own reader ends there, and takes as much memory as a broken length says.
class LogReader {
 public:
  /// Throws host::InputError where the file cannot be read.
  explicit LogReader(const std::string& path);

  /// The next whole message; empty at the file's end.
  std::optional<LogMessage> next();
  /// The same without its bytes.
  std::optional<LogMessage> next_header();

  /// Where the next message is looked for.
  std::int64_t position() const { return position_; }
  /// Continues at a position() of before.
  void seek(std::int64_t position);
  /// Broken pieces since the start.
  std::int64_t skipped() const { return skipped_; }
  std::int64_t size() const { return size_; }

 private:
  std::optional<LogMessage> next_message(bool with_bytes);
  bool find_mark();
  bool read(void* to, std::size_t size);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::int64_t size_ = 0;
  std::int64_t position_ = 0;
  std::int64_t skipped_ = 0;
};

}  // namespace pharos::tools
