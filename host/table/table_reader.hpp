// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/table/line_reader.hpp"

namespace pharos::host {

/// A CSV table with a header row; columns are found by name, in any order and among others.
///
/// Every error is an InputError that names file, line and column. Numbers are strict: nothing may follow them, nan and
/// infinity are refused. No quoting: no table of Pharos needs it.
class TableReader {
 public:
  /// Reads the header. Throws InputError when the table is empty, or a column of `columns` is missing or duplicate.
  TableReader(ByteSource source, std::vector<std::string> columns, LastLine last_line = LastLine::kAccept);

  /// Whether the header has `column` (an optional one), which then has the next column index of the reader.
  std::optional<std::size_t> find_optional(const std::string& column);

  /// Goes to the next row; false at the end. Throws when the row has another number of fields than the header.
  bool next();

  // Fields of the present row; `column` counts as in the constructor.
  std::string_view text(std::size_t column) const { return fields_[position_[column]]; }
  bool empty(std::size_t column) const { return text(column).empty(); }
  double number(std::size_t column) const;
  /// Empty field: no value.
  std::optional<double> optional_number(std::size_t column) const;
  std::int64_t integer(std::size_t column, std::int64_t minimum, std::int64_t maximum) const;

  /// An InputError about `column` of the present row: "FILE: line N: column 'c': WHAT".
  [[noreturn]] void fail(std::size_t column, const std::string& what) const;
  /// An InputError about the present row.
  [[noreturn]] void fail_row(const std::string& what) const;

  std::size_t line_number() const { return lines_.line_number(); }
  bool ended_unfinished() const { return lines_.ended_unfinished(); }
  const std::string& name() const { return lines_.name(); }

 private:
  void read_header();
  std::size_t require(const std::string& column) const;

  LineReader lines_;
  std::vector<std::string> columns_;
  std::vector<std::string> header_;
  std::vector<std::size_t> position_;  // of columns_[i] in a row
  std::vector<std::string_view> fields_;
};

/// `text` without spaces and tabs around it.
std::string_view trimmed(std::string_view text);
/// `text` in single quotes for a message: cut to 40 characters, unprintable ones as '?'.
std::string quoted(std::string_view text);

}  // namespace pharos::host
