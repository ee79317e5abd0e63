// SPDX-License-Identifier: Apache-2.0
#include "tools/lcm_log/lcm_log.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pharos::tools {
namespace {

constexpr std::string_view kWord("\xED\xA1\xDA\x01", 4);
constexpr std::size_t kHeaderBytes = 28;
constexpr std::size_t kTimeAt = 12, kChannelLengthAt = 20, kDataLengthAt = 24;

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<std::uint8_t>(byte);
  return value;
}

}  // namespace

struct LcmLogReader::Header {
  std::int64_t utime_us = 0;
  std::size_t channel = 0, data = 0;

  std::size_t end() const { return kHeaderBytes + channel + data; }
};

LcmLogReader::LcmLogReader(host::ByteSource source, std::int64_t position)
    : source_(std::move(source)), dropped_(source_.skip(position)) {}

// Reads until so many bytes are there; false where the log ends before.
bool LcmLogReader::have(std::size_t count) {
  std::array<char, 65536> part;
  while (buffer_.size() - begin_ < count && !ended_) {
    const std::size_t got = source_.read(part);
    if (got == 0) ended_ = true;
    buffer_.append(part.data(), got);
  }
  return buffer_.size() - begin_ >= count;
}

// None where the bytes begin no message that is allowed.
std::optional<LcmLogReader::Header> LcmLogReader::header() {
  const std::string_view bytes = std::string_view(buffer_).substr(begin_);
  if (!bytes.starts_with(kWord)) return std::nullopt;
  Header header;
  header.utime_us = static_cast<std::int64_t>(big_endian(bytes.substr(kTimeAt, 8)));
  header.channel = big_endian(bytes.substr(kChannelLengthAt, 4));
  header.data = big_endian(bytes.substr(kDataLengthAt, 4));
  if (header.channel == 0 || header.channel > kMaxChannel || header.data > kMaxData) return std::nullopt;
  return header;
}

// Whether the next message, or the end, follows. Empty: the log ends within this message.
std::optional<bool> LcmLogReader::whole(const Header& header) {
  if (!have(header.end())) return std::nullopt;
  have(header.end() + kWord.size());
  const std::string_view after = std::string_view(buffer_).substr(begin_ + header.end(), kWord.size());
  return kWord.starts_with(after);
}

void LcmLogReader::count_skipped(std::size_t count) {
  if (!in_damage_) ++counters_.damaged;
  in_damage_ = true;
  counters_.bytes_skipped += static_cast<std::int64_t>(count);
  begin_ += count;
}

// To the next word behind the present place; false where there is none.
bool LcmLogReader::skip_to_next_word() {
  for (std::size_t from = 1;;) {
    const std::size_t found = buffer_.find(kWord, begin_ + from);
    if (found != std::string::npos) {
      count_skipped(found - begin_);
      return true;
    }
    // The word may be cut by the end of what was read.
    const std::size_t searched = buffer_.size() - begin_;
    if (!have(searched + 1)) return false;
    const std::size_t kept = std::min(searched - 1, kWord.size() - 1);
    count_skipped(searched - kept);
    drop_used();
    from = 0;
  }
}

void LcmLogReader::drop_used() {
  buffer_.erase(0, begin_);
  dropped_ += static_cast<std::int64_t>(begin_);
  begin_ = 0;
}

std::optional<LoggedMessage> LcmLogReader::next() {
  if (2 * begin_ > buffer_.size()) drop_used();
  while (have(1)) {
    if (have(kHeaderBytes)) {
      if (const auto found = header()) {
        const auto complete = whole(*found);
        if (complete && *complete) {
          in_damage_ = false;
          ++counters_.messages;
          const std::string_view all = std::string_view(buffer_).substr(begin_, found->end());
          begin_ += found->end();
          return LoggedMessage{found->utime_us, all.substr(kHeaderBytes, found->channel),
                               all.substr(kHeaderBytes + found->channel)};
        }
      }
    }
    if (skip_to_next_word()) continue;
    // The rest holds no further message: a message that was being written, or bytes behind the last one.
    counters_.cut_off =
        std::string_view(buffer_).substr(begin_).starts_with(kWord) && (!have(kHeaderBytes) || header());
    if (counters_.cut_off) {
      begin_ = buffer_.size();
    } else {
      count_skipped(buffer_.size() - begin_);
    }
  }
  return std::nullopt;
}

}  // namespace pharos::tools
