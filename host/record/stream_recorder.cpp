// SPDX-License-Identifier: Apache-2.0
#include "host/record/stream_recorder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

namespace pharos::host {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr std::int64_t kRetry_ns = kNsPerS;
constexpr int kFilePermissions = 0644;
/// Files of one target begun within one second.
constexpr int kMaxNamesakes = 1000;

std::string utc_word(std::int64_t utc_ns) {
  const std::time_t seconds = utc_ns / kNsPerS;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> word{};
  const std::size_t size = std::strftime(word.data(), word.size(), "%Y%m%dT%H%M%SZ", &parts);
  return {word.data(), size};
}

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
    if (write_all(scratch_)) {
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
    const double age_s = static_cast<double>(monotonic_ns - file_begun_ns_) / static_cast<double>(kNsPerS);
    if (file_bytes_ < options_.rotate_bytes && age_s < options_.rotate_s) return true;
    close_file();
  }
  if (!error_.empty() && monotonic_ns < retry_at_ns_) return false;
  return open_file(utc_ns, monotonic_ns);
}

bool StreamRecorder::open_file(std::int64_t utc_ns, std::int64_t monotonic_ns) {
  std::error_code ignored;  // if the folder cannot be created, opening the file fails and reports why
  std::filesystem::create_directories(options_.directory, ignored);
  const std::string stem = options_.target + "_" + utc_word(utc_ns);
  for (int namesake = 0; namesake < kMaxNamesakes && !fd_.valid(); ++namesake) {
    file_ = options_.directory / (stem + (namesake == 0 ? "" : "_" + std::to_string(namesake)) + ".phraw");
    fd_.reset(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kFilePermissions));
    if (!fd_.valid() && errno != EEXIST) break;
  }
  if (!fd_.valid()) {
    fail(file_.string() + ": cannot be opened", errno, monotonic_ns);
    return false;
  }
  const auto head =
      stream_format::encode_head({options_.target, static_cast<std::uint32_t>(options_.baud), utc_ns, monotonic_ns});
  file_bytes_ = 0;
  holds_chunks_ = false;
  if (!write_all(head)) {
    fail(file_.string() + ": cannot be written", errno, monotonic_ns);
    return false;
  }
  file_bytes_ = head.size();
  file_begun_ns_ = monotonic_ns;
  return true;
}

bool StreamRecorder::write_all(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
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
