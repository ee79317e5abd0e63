// SPDX-License-Identifier: Apache-2.0
#include "host/table/table_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kLongestShown = 40;

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, kLongestShown)) out += c < ' ' || c > '~' ? '?' : c;
  out += text.size() > kLongestShown ? "…'" : "'";
  return out;
}

TableReader::TableReader(ByteSource source, std::vector<std::string> columns, LastLine last_line)
    : lines_(std::move(source), last_line), columns_(std::move(columns)) {
  read_header();
  for (const std::string& column : columns_) position_.push_back(require(column));
}

void TableReader::read_header() {
  std::optional<std::string_view> line = lines_.next();
  if (!line) throw InputError(name() + ": empty; a table starts with the header row " + joined(columns_));
  if (line->starts_with(kByteOrderMark)) line->remove_prefix(kByteOrderMark.size());
  split(*line, fields_);
  header_.assign(fields_.begin(), fields_.end());
}

std::size_t TableReader::require(const std::string& column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) {
    throw InputError(name() + ": line " + std::to_string(line_number()) + ": no column '" + column +
                     "'; the header must have " + joined(columns_) + ", it is " + quoted(joined(header_)));
  }
  if (std::find(found + 1, header_.end(), column) != header_.end()) {
    throw InputError(name() + ": line " + std::to_string(line_number()) + ": column '" + column +
                     "' stands twice in the header; remove one");
  }
  return static_cast<std::size_t>(found - header_.begin());
}

std::optional<std::size_t> TableReader::find_optional(const std::string& column) {
  if (std::find(header_.begin(), header_.end(), column) == header_.end()) return std::nullopt;
  position_.push_back(require(column));
  columns_.push_back(column);
  return columns_.size() - 1;
}

bool TableReader::next() {
  const std::optional<std::string_view> line = lines_.next();
  if (!line) return false;
  split(*line, fields_);
  if (fields_.size() != header_.size()) {
    fail_row(std::to_string(fields_.size()) + " fields where the header has " + std::to_string(header_.size()));
  }
  return true;
}

double TableReader::number(std::size_t column) const {
  const std::string_view field = text(column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
    fail(column, quoted(field) + " is not a number");
  }
  return value;
}

std::optional<double> TableReader::optional_number(std::size_t column) const {
  if (empty(column)) return std::nullopt;
  return number(column);
}

std::int64_t TableReader::integer(std::size_t column, std::int64_t minimum, std::int64_t maximum) const {
  const std::string_view field = text(column);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || value < minimum || value > maximum) {
    fail(column,
         quoted(field) + " is not a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum));
  }
  return value;
}

void TableReader::fail(std::size_t column, const std::string& what) const {
  fail_row("column '" + columns_[column] + "': " + what);
}

void TableReader::fail_row(const std::string& what) const {
  throw InputError(name() + ": line " + std::to_string(line_number()) + ": " + what);
}

}  // namespace pharos::host
