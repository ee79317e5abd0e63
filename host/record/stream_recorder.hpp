// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/record/stream_format.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

struct RecorderOptions {
  std::filesystem::path directory;  // created where it does not exist
  std::string target;
  int baud = 0;
  // A new file begins at whichever comes first.
  std::uint64_t rotate_bytes = 64u << 20;
  double rotate_s = 3600.0;
};

struct RecorderCounters {
  std::uint64_t bytes_recorded = 0;  // of the stream
  std::uint64_t bytes_lost = 0;      // of the stream: they could not be written
  std::uint64_t files = 0;           // that hold a chunk
  std::uint64_t failures = 0;        // to open or to write
};

/// Records a raw serial stream into a series of files `TARGET_YYYYMMDDTHHMMSSZ[_N].phraw`.
///
/// Never throws and never delays the poses: bytes that cannot be written (disk full, folder gone) are counted, reported
/// by error(), and marked in the recording when it continues; writing is tried again once a second. Files always end
/// with a complete chunk, and no file has only a head. One write() a chunk, no buffer: appended bytes survive a crash
/// of the program. The program must ignore SIGXFSZ, or a limit on file sizes ends it.
class StreamRecorder {
 public:
  explicit StreamRecorder(RecorderOptions options) : options_(std::move(options)) {}

  /// Bytes that arrived, and when; time must not run backwards by the monotonic clock.
  void append(std::span<const std::uint8_t> bytes, std::int64_t utc_ns, std::int64_t monotonic_ns);

  const RecorderCounters& counters() const { return counters_; }
  /// Why nothing is recorded at the moment, one line for the user; empty when there is no error.
  const std::string& error() const { return error_; }
  /// The file that is being written; empty when none is.
  const std::filesystem::path& file() const { return file_; }

 private:
  void append_chunk(std::span<const std::uint8_t> bytes, std::int64_t utc_ns, std::int64_t monotonic_ns);
  bool ready(std::int64_t utc_ns, std::int64_t monotonic_ns);
  bool open_file(std::int64_t utc_ns, std::int64_t monotonic_ns);
  void fail(const std::string& doing, int error, std::int64_t monotonic_ns);
  void close_file();

  RecorderOptions options_;
  RecorderCounters counters_;
  std::string error_;
  UniqueFd fd_;
  std::filesystem::path file_;
  std::uint64_t file_bytes_ = 0;  // head and whole chunks only
  bool holds_chunks_ = false;
  std::int64_t file_begun_ns_ = 0;
  std::int64_t retry_at_ns_ = 0;
  std::uint64_t lost_before_ = 0;  // since the last chunk written
  std::vector<std::uint8_t> scratch_;
};

}  // namespace pharos::host
