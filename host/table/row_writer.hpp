// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pharos::host {

enum class RowFormat { kCsv, kJson };

/// Writes rows of named fields: CSV with a header row, or one JSON object a line with the same names.
///
/// Numbers are the shortest text that reads back exactly. A field without a value is empty in CSV and null in JSON; so
/// are an empty text and a number that is not finite: empty in one form is null in the other, and nan is never written.
/// Fields are written in the order of the columns, each row ended with end_row(); another number of fields is a bug of
/// the caller (asserted).
class RowWriter {
 public:
  /// Does not own `stream`. The CSV header is written at once.
  RowWriter(std::FILE* stream, RowFormat format, std::vector<std::string> columns);
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;
  ~RowWriter();

  RowWriter& number(double value);
  RowWriter& number(std::optional<double> value) { return value ? number(*value) : none(); }
  RowWriter& integer(std::int64_t value);
  RowWriter& text(std::string_view value);
  RowWriter& none();
  /// `count` fields without a value.
  RowWriter& none(std::size_t count);
  void end_row();

  /// Flushes the stream (for a live reader). Throws InputError when the stream cannot be written (disk full).
  void flush();
  std::size_t rows() const { return rows_; }

 private:
  void begin_field();

  std::FILE* stream_;
  RowFormat format_;
  std::vector<std::string> columns_;
  std::string buffer_;
  std::size_t field_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace pharos::host
