// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/comparison_table.hpp"

#include <algorithm>
#include <cstdio>

#include "host/table/row_writer.hpp"

namespace pharos::tools {
namespace {

std::string rounded(const std::optional<double>& value) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", *value);
  return text;
}

void write_pretty(const std::vector<BenchRow>& rows) {
  std::size_t width = 4;
  for (const BenchRow& row : rows) width = std::max(width, row.what.size());
  const int columns = static_cast<int>(width);
  std::printf("%-*s %10s %10s %8s  %s\n", columns, "what", "ours", "peer", "ratio", "unit");
  for (const BenchRow& row : rows) {
    std::printf("%-*s %10s %10s %8s  %s\n", columns, row.what.c_str(), rounded(row.ours).c_str(),
                rounded(row.peer).c_str(), rounded(row.ratio()).c_str(), row.unit.c_str());
  }
}

}  // namespace

std::optional<double> BenchRow::ratio() const {
  if (!peer || *peer == 0.0 || ours == 0.0) return std::nullopt;
  return less_is_better ? *peer / ours : ours / *peer;
}

void write_rows(const std::vector<BenchRow>& rows, BenchForm form) {
  if (form == BenchForm::kPretty) return write_pretty(rows);
  host::RowWriter writer(stdout, form == BenchForm::kCsv ? host::RowFormat::kCsv : host::RowFormat::kJson,
                         {"what", "ours", "peer", "ratio", "unit"});
  for (const BenchRow& row : rows) {
    writer.text(row.what).number(row.ours).number(row.peer).number(row.ratio()).text(row.unit).end_row();
  }
  writer.flush();
}

}  // namespace pharos::tools
