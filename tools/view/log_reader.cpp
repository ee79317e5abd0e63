// SPDX-License-Identifier: Apache-2.0
#include "tools/view/log_reader.hpp"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

// An event: this mark, number (8 bytes), time (8), length of the channel's name (4), of the message (4), both; all
// big-endian.
constexpr std::uint32_t kMark = 0xEDA1DA01;
constexpr std::size_t kMark_bytes = 4;
constexpr std::size_t kHeader_bytes = 24;
// LCM's own limits: a name of 63 characters; no message of Pharos comes near this one.
constexpr std::int32_t kMaxName_bytes = 63;
constexpr std::int32_t kMaxMessage_bytes = 1 << 24;

std::uint64_t big_endian(const unsigned char* bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[i];
  return value;
}

}  // namespace

LogReader::LogReader(const std::string& path) : file_(std::fopen(path.c_str(), "rbe"), &std::fclose) {
  struct stat status {};
  if (file_ == nullptr || ::fstat(::fileno(file_.get()), &status) != 0) {
    throw host::InputError(path + ": " + std::strerror(errno) + "; give a log of lcm-logger");
  }
  if (!S_ISREG(status.st_mode)) throw host::InputError(path + ": is not a file; give a log of lcm-logger");
  size_ = status.st_size;
}

void LogReader::seek(std::int64_t position) {
  position_ = position;
  std::fseek(file_.get(), position, SEEK_SET);
}

bool LogReader::read(void* to, std::size_t size) {
  const std::size_t got = std::fread(to, 1, size, file_.get());
  position_ += static_cast<std::int64_t>(got);
  return got == size;
}

// Reads up to and with the next mark. Bytes before it are one broken piece.
bool LogReader::find_mark() {
  std::array<unsigned char, kMark_bytes> mark{};
  if (!read(mark.data(), mark.size())) return false;
  auto value = static_cast<std::uint32_t>(big_endian(mark.data(), mark.size()));
  if (value == kMark) return true;
  ++skipped_;
  for (int c = 0; (c = std::fgetc(file_.get())) != EOF;) {
    ++position_;
    value = value << 8U | static_cast<std::uint32_t>(c);
    if (value == kMark) return true;
  }
  return false;
}

std::optional<LogMessage> LogReader::next_message(bool with_bytes) {
  while (find_mark()) {
    const std::int64_t after_mark = position_;
    std::array<unsigned char, kHeader_bytes> header{};
    if (!read(header.data(), header.size())) break;
    const auto name_size = static_cast<std::int32_t>(big_endian(&header[16], 4));
    const auto size = static_cast<std::int32_t>(big_endian(&header[20], 4));
    if (name_size < 1 || name_size > kMaxName_bytes || size < 0 || size > kMaxMessage_bytes ||
        position_ + name_size + size > size_) {
      ++skipped_;
      seek(after_mark);  // the true next mark may lie within what this header claims
      continue;
    }
    LogMessage message;
    message.utime_us = static_cast<std::int64_t>(big_endian(&header[8], 8));
    message.channel.resize(static_cast<std::size_t>(name_size));
    if (!read(message.channel.data(), message.channel.size())) break;
    if (with_bytes) {
      message.bytes.resize(static_cast<std::size_t>(size));
      if (!read(message.bytes.data(), message.bytes.size())) break;
    } else {
      seek(position_ + size);
    }
    return message;
  }
  return std::nullopt;
}

std::optional<LogMessage> LogReader::next() { return next_message(true); }
std::optional<LogMessage> LogReader::next_header() { return next_message(false); }

}  // namespace pharos::tools
