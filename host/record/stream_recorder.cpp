// SPDX-License-Identifier: Apache-2.0
#include "host/record/stream_recorder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "host/record/recording_file.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kRetry_ns = kNsPerSecond;

}  // namespace

void StreamRecorder::append(std::span<const std::uint8_t> bytes, std::int64_t utc_ns, std::int64_t monotonic_ns) {
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), stream_format::kMaxChunkBytes));
    append_chunk(part, utc_ns, monotonic_ns);
    bytes = bytes.subspan(part.size());
  }
}

void StreamRecorder::append_chunk(std::span<const std::uint8_t> bytes, std::int64_t utc_ns, std::int64_t monotonic_ns) {
  if (ready(utc_ns, monotonic_ns)) {
    scratch_.clear();
    stream_format::append_chunk({utc_ns, monotonic_ns, lost_before_, bytes}, scratch_);
    if (write_all(fd_.get(), scratch_)) {
      if (!holds_chunks_) ++counters_.files;
      holds_chunks_ = true;
      file_bytes_ += scratch_.size();
      counters_.bytes_recorded += bytes.size();
      lost_before_ = 0;
      error_.clear();
      return;
    }
    fail(file_.string() + ": cannot be written", errno, monotonic_ns);
  }
  counters_.bytes_lost += bytes.size();
  lost_before_ += bytes.size();
}

bool StreamRecorder::ready(std::int64_t utc_ns, std::int64_t monotonic_ns) {
  if (fd_.valid()) {
    const double age_s = static_cast<double>(monotonic_ns - file_begun_ns_) / static_cast<double>(kNsPerSecond);
    if (file_bytes_ < options_.rotate_bytes && age_s < options_.rotate_s) return true;
    close_file();
  }
  if (!error_.empty() && monotonic_ns < retry_at_ns_) return false;
  return open_file(utc_ns, monotonic_ns);
}

bool StreamRecorder::open_file(std::int64_t utc_ns, std::int64_t monotonic_ns) {
  fd_ = create_recording_file(options_.directory, options_.target, kStreamSuffix, utc_ns, file_);
  if (!fd_.valid()) {
    fail(file_.string() + ": cannot be opened", errno, monotonic_ns);
    return false;
  }
  const auto head =
      stream_format::encode_head({options_.target, static_cast<std::uint32_t>(options_.baud), utc_ns, monotonic_ns});
  file_bytes_ = 0;
  holds_chunks_ = false;
  if (!write_all(fd_.get(), head)) {
    fail(file_.string() + ": cannot be written", errno, monotonic_ns);
    return false;
  }
  file_bytes_ = head.size();
  file_begun_ns_ = monotonic_ns;
  return true;
}

void StreamRecorder::fail(const std::string& doing, int error, std::int64_t monotonic_ns) {
  ++counters_.failures;
  error_ = doing + ": " + std::strerror(error) + "; the stream is not being recorded";
  retry_at_ns_ = monotonic_ns + kRetry_ns;
  // The incomplete chunk is removed, and with it a file without any chunk: on a full disk every attempt would leave
  // another one.
  if (fd_.valid()) {
    const bool cleaned =
        holds_chunks_ ? ::ftruncate(fd_.get(), static_cast<off_t>(file_bytes_)) == 0 : ::unlink(file_.c_str()) == 0;
    if (!cleaned) {
      ++counters_.failures;
      error_ += "; " + file_.string() + (holds_chunks_ ? " ends with a broken chunk" : " is left without content");
    }
  }
  close_file();
}

void StreamRecorder::close_file() {
  fd_.reset();
  file_.clear();
}

}  // namespace pharos::host
