// SPDX-License-Identifier: Apache-2.0
#include "host/table/row_writer.hpp"

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kFlushAt = 64 * 1024;
// Longest shortest-form double: -2.2250738585072014e-308.
constexpr std::size_t kNumberChars = 32;

template <class T>
void append_number(std::string& out, T value) {
  std::array<char, kNumberChars> chars;
  const auto result = std::to_chars(chars.data(), chars.data() + chars.size(), value);
  out.append(chars.data(), result.ptr);
}

bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code < 0x20 || code == 0x7F;
}

void append_json_text(std::string& out, std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (is_control(c)) {
      out += "\\u00";
      out += kHex[code >> 4];
      out += kHex[code & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

// CSV of Pharos has no quoting: characters that would break a row, or that a terminal obeys, are replaced.
void append_csv_text(std::string& out, std::string_view text) {
  for (const char c : text) out += c == ',' || is_control(c) ? ' ' : c;
}

}  // namespace

RowWriter::RowWriter(std::FILE* stream, RowFormat format, std::vector<std::string> columns, const RowExtras& extras)
    : stream_(stream),
      format_(format),
      columns_(std::move(columns)),
      covariance_(extras.covariance),
      tum_(extras.series) {
  assert(!covariance_ || format_ != RowFormat::kTum);
  if (covariance_) {
    for (const std::string& column : covariance_columns()) columns_.push_back(column);
  }
  if (format_ != RowFormat::kCsv) return;
  for (const std::string& column : columns_) buffer_ += (buffer_.empty() ? "" : ",") + column;
  buffer_ += '\n';
}

RowWriter::~RowWriter() {
  // For early returns only; callers that must detect a full disk call flush() themselves.
  // After flush() the stream may be closed already.
  if (buffer_.empty()) return;
  std::fwrite(buffer_.data(), 1, buffer_.size(), stream_);
  std::fflush(stream_);
}

// False where the form has no fields.
bool RowWriter::begin_field() {
  assert(field_ < columns_.size());
  if (format_ == RowFormat::kTum) {
    ++field_;
    return false;
  }
  if (format_ == RowFormat::kCsv) {
    if (field_ > 0) buffer_ += ',';
  } else {
    buffer_ += field_ == 0 ? '{' : ',';
    append_json_text(buffer_, columns_[field_]);
    buffer_ += ':';
  }
  ++field_;
  return true;
}

RowWriter& RowWriter::number(double value) {
  if (!std::isfinite(value)) return none();
  if (begin_field()) append_number(buffer_, value);
  return *this;
}

RowWriter& RowWriter::integer(std::int64_t value) {
  if (begin_field()) append_number(buffer_, value);
  return *this;
}

RowWriter& RowWriter::text(std::string_view value) {
  if (value.empty()) return none();
  if (!begin_field()) return *this;
  if (format_ == RowFormat::kJson) {
    append_json_text(buffer_, value);
  } else {
    append_csv_text(buffer_, value);
  }
  return *this;
}

RowWriter& RowWriter::none() {
  if (begin_field() && format_ == RowFormat::kJson) buffer_ += "null";
  return *this;
}

RowWriter& RowWriter::none(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) none();
  return *this;
}

RowWriter& RowWriter::pose(RowPose pose) {
  pose_ = std::move(pose);
  return *this;
}

void RowWriter::write_covariance() {
  if (!pose_ || !pose_->covariance) {
    none(static_cast<std::size_t>(Matrix6::SizeAtCompileTime));
    return;
  }
  for (int i = 0; i < Matrix6::RowsAtCompileTime; ++i) {
    for (int j = 0; j < Matrix6::ColsAtCompileTime; ++j) number((*pose_->covariance)(i, j));
  }
}

void RowWriter::end_row() {
  if (covariance_) write_covariance();
  assert(field_ == columns_.size());
  if (format_ == RowFormat::kTum) {
    buffer_ += tum_.line(pose_);
  } else {
    buffer_ += format_ == RowFormat::kJson ? "}\n" : "\n";
  }
  pose_.reset();
  field_ = 0;
  ++rows_;
  if (buffer_.size() >= kFlushAt) flush();
}

void RowWriter::flush() {
  const std::size_t written = std::fwrite(buffer_.data(), 1, buffer_.size(), stream_);
  const bool good = written == buffer_.size() && std::fflush(stream_) == 0;
  buffer_.clear();
  if (!good) throw InputError(std::string("the output takes no more: ") + std::strerror(errno));
}

}  // namespace pharos::host
