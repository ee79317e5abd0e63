// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/table/row_pose.hpp"
#include "host/table/tum_lines.hpp"

namespace pharos::host {

enum class RowFormat { kCsv, kJson, kTum };

/// What a table contains beside its columns.
struct RowExtras {
  bool covariance = false;  // 36 further columns at the end (covariance_columns); not with kTum
  std::string series = {};  // with kTum: the series to write (TumLines)
};

/// Writes rows of named fields: CSV with a header row, or one JSON object a line with the same names, or only the rows'
/// poses as lines of TUM (tum_lines.hpp).
///
/// Numbers are the shortest text that reads back exactly. A field without a value is empty in CSV and null in JSON; so
/// are an empty text and a number that is not finite: empty in one form is null in the other, and nan is never written.
/// Fields are written in the order of the columns, each row ended with end_row(); another number of fields is a bug of
/// the caller (asserted).
class RowWriter {
 public:
  /// Does not own `stream`. The CSV header is written at once.
  RowWriter(std::FILE* stream, RowFormat format, std::vector<std::string> columns, const RowExtras& extras = {});
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
  /// The present row's pose, for TUM and the covariance; a row without one is a refusal.
  RowWriter& pose(RowPose pose);
  void end_row();

  /// Flushes the stream (for a live reader). Throws InputError when the stream cannot be written (disk full).
  void flush();
  std::size_t rows() const { return rows_; }
  /// Lines of TUM, and the rows that have none; of other forms nothing.
  const TumLines& tum() const { return tum_; }

 private:
  bool begin_field();
  void write_covariance();

  std::FILE* stream_;
  RowFormat format_;
  std::vector<std::string> columns_;
  bool covariance_;
  TumLines tum_;
  std::optional<RowPose> pose_;  // of the present row
  std::string buffer_;
  std::size_t field_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace pharos::host
