// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "host/table/row_writer.hpp"
#include "tools/evaluation/bench/bench_target.hpp"

namespace pharos::tools {
namespace {

std::string rounded(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "-";
  char text[48];
  std::snprintf(text, sizeof text, *value >= 1000.0 ? "%.0f" : "%.4g", *value);
  return unit.empty() ? text : text + (" " + unit);
}

void write_pretty(const std::vector<TargetRow>& rows) {
  std::size_t width = 4;
  for (const TargetRow& row : rows) width = std::max(width, row.what.size());
  const int columns = static_cast<int>(width);
  std::printf("%-*s %22s %10s %12s\n", columns, "what", "soft core", "at most", "host");
  for (const TargetRow& row : rows) {
    std::printf("%-*s %22s %10s %12s\n", columns, row.what.c_str(), rounded(row.target, row.unit).c_str(),
                rounded(row.limit, "").c_str(), rounded(row.host, row.host ? row.host_unit : "").c_str());
  }
}

}  // namespace

void write_target_rows(const std::vector<TargetRow>& rows, BenchForm form) {
  if (form == BenchForm::kPretty) return write_pretty(rows);
  host::RowWriter writer(stdout, form == BenchForm::kCsv ? host::RowFormat::kCsv : host::RowFormat::kJson,
                         {"what", "target", "limit", "unit", "host", "host_unit"});
  for (const TargetRow& row : rows) {
    writer.text(row.what).number(row.target).number(row.limit).text(row.unit).number(row.host).text(row.host_unit);
    writer.end_row();
  }
  writer.flush();
}

}  // namespace pharos::tools
