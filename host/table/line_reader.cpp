// SPDX-License-Identifier: Apache-2.0
#include "host/table/line_reader.hpp"

#include <cstring>
#include <string>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kLongestLine = 64 * 1024;
constexpr std::size_t kBuffer = 4 * kLongestLine;

}  // namespace

LineReader::LineReader(ByteSource source, LastLine last_line)
    : source_(std::move(source)), last_line_(last_line), buffer_(kBuffer) {}

std::optional<std::string_view> LineReader::next() {
  for (;;) {
    std::optional<std::string_view> line = next_raw();
    if (!line) return std::nullopt;
    ++line_number_;
    if (!line->empty() && line->back() == '\r') line->remove_suffix(1);
    if (std::memchr(line->data(), '\0', line->size()) != nullptr) refuse("binary data, not a table");
    if (!line->empty()) return line;
  }
}

std::optional<std::string_view> LineReader::next_raw() {
  for (;;) {
    const void* found = std::memchr(buffer_.data() + scanned_, '\n', end_ - scanned_);
    if (found != nullptr) {
      const auto line_end = static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data());
      const std::string_view line(buffer_.data() + begin_, line_end - begin_);
      begin_ = scanned_ = line_end + 1;
      return line;
    }
    scanned_ = end_;
    if (end_ - begin_ > kLongestLine) {
      ++line_number_;
      refuse("a line of more than 64 KiB, not a table");
    }
    if (!fill()) break;
  }
  if (begin_ == end_) return std::nullopt;
  const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
  begin_ = scanned_ = end_;
  if (last_line_ == LastLine::kAccept && !source_.cut_off()) return rest;
  ended_unfinished_ = true;
  return std::nullopt;
}

bool LineReader::fill() {
  if (buffer_.size() - end_ < kLongestLine) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    scanned_ -= begin_;
    begin_ = 0;
  }
  const std::size_t got = source_.read(std::span(buffer_).subspan(end_));
  end_ += got;
  return got > 0;
}

void LineReader::refuse(const char* why) const {
  throw InputError(source_.name() + ": line " + std::to_string(line_number_) + ": " + why);
}

}  // namespace pharos::host
