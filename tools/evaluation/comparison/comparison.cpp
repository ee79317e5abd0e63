// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/comparison/comparison.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "host/files/atomic_file.hpp"

namespace pharos::tools {

std::string rounded(double value) {
  std::array<char, 32> text;
  const int size = std::snprintf(text.data(), text.size(), "%.3g", value);
  // %g uses exponents early; integers of moderate size are easier to read without.
  if (std::abs(value) >= 1000.0 && std::abs(value) < 1e7) {
    return std::to_string(std::llround(value));
  }
  return {text.data(), static_cast<std::size_t>(size)};
}

std::string rounded_as(double value, const std::string& published) {
  double number = 0.0;
  const char* end = published.data() + published.size();
  const auto result = std::from_chars(published.data(), end, number);
  const std::size_t point = published.find('.');
  const bool plain =
      result.ec == std::errc() && result.ptr == end && published.find_first_of("eE") == std::string::npos;
  if (!plain || point == std::string::npos || !(std::abs(value) < 1e7)) return rounded(value);
  constexpr int kDigits = 3;
  const int before = value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  const auto decimals = static_cast<int>(published.size() - point - 1);
  if (before + decimals <= kDigits) return rounded(value);
  std::array<char, 32> text;
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return {text.data(), static_cast<std::size_t>(size)};
}

namespace {

bool any_theirs(const std::vector<ComparisonRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const ComparisonRow& row) { return row.theirs.has_value(); });
}

std::string shown(const std::optional<double>& value, const std::string& unit) {
  return value ? rounded(*value) + unit : "";
}

bool any_further(const std::vector<ComparisonRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const ComparisonRow& row) { return row.further.has_value(); });
}

}  // namespace

std::optional<double> ratio_of(const ComparisonRow& row) {
  double published = 0.0;
  const char* end = row.expected.data() + row.expected.size();
  const auto result = std::from_chars(row.expected.data(), end, published);
  if (result.ec != std::errc{} || result.ptr != end || published == 0.0) return std::nullopt;
  if (!row.ours || !row.comparable) return std::nullopt;
  return *row.ours / published;
}

std::optional<double> ratio_to_theirs(const ComparisonRow& row) {
  if (!row.ours || !row.theirs || !row.comparable || *row.theirs == 0.0) return std::nullopt;
  return *row.ours / *row.theirs;
}

void write_rows(const std::vector<ComparisonRow>& rows, const OutputOptions& options) {
  std::vector<std::string> columns = {"item", "what", "unit", "published", "ours", "ratio", "remark"};
  const bool further = any_further(rows);
  if (further) columns.insert(columns.end(), {"calibrated", "motion", "both"});
  const bool theirs = any_theirs(rows);
  if (theirs) columns.emplace_back("theirs");
  Output output(options, columns);
  for (const ComparisonRow& row : rows) {
    host::RowWriter& out = output.rows();
    out.text(row.item).text(row.what).text(row.unit).text(row.expected);
    out.number(row.ours).number(ratio_of(row)).text(row.remark);
    if (further && row.further) {
      out.number(row.further->calibrated).number(row.further->motion).number(row.further->both);
    } else if (further) {
      out.none(3);
    }
    if (theirs) out.number(row.theirs);
    out.end_row();
  }
  output.finish();
}

void write_markdown(const std::vector<ComparisonRow>& rows, const std::string& path) {
  const bool further = any_further(rows);
  const bool theirs = any_theirs(rows);
  std::string text = std::string("| item | what | published or asked | ") + (theirs ? "theirs rerun | " : "") +
                     "ours | ratio | remark |" + (further ? " + calibration | + motion | both |" : "") +
                     "\n|---|---|---|---|---|---|" + (theirs ? "---|" : "") + (further ? "---|---|---|" : "") + "\n";
  for (const ComparisonRow& row : rows) {
    const std::optional<double> ratio = ratio_of(row);
    const std::string unit = row.unit.empty() ? "" : " " + row.unit;
    text += "| " + row.item + " | " + row.what + " | " + (row.expected.empty() ? "" : row.expected + unit) + " | " +
            (theirs ? shown(row.theirs, unit) + " | " : "") + shown(row.ours, unit) + " | " + shown(ratio, "") + " | " +
            row.remark + " |";
    if (further && row.further) {
      const FurtherColumns& more = *row.further;
      text += " " + rounded(more.calibrated) + unit + " | " + rounded(more.motion) + unit + " | " + rounded(more.both) +
              unit + " |";
    } else if (further) {
      text += " | | |";
    }
    text += "\n";
  }
  host::write_file(path, text);
}

void write_comparison(const std::vector<ComparisonRow>& rows, bool markdown, const OutputOptions& options) {
  if (markdown) {
    write_markdown(rows, options.path);
  } else {
    write_rows(rows, options);
  }
}

}  // namespace pharos::tools
