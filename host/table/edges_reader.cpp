// SPDX-License-Identifier: Apache-2.0
#include "host/table/edges_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"

namespace pharos::host {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"sensor", "rise_ticks", "fall_ticks"};
constexpr std::string_view kEdgesByteOrderMark = "\xEF\xBB\xBF";
// Limit of readings, so far below 64 bits that no sum of a few can overflow; 2^60 ticks are 731 years.
constexpr std::int64_t kLargestReading = std::int64_t{1} << 60;

std::size_t column_named(std::string_view name) {
  return static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

bool parse_whole(std::string_view field, std::int64_t& value) {
  field = trimmed(field);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc{} && end == field.data() + field.size() && value >= -kLargestReading &&
         value <= kLargestReading;
}

}  // namespace

EdgesReader::EdgesReader(ByteSource source) : lines_(std::move(source), LastLine::kDropUnfinished) { read_header(); }

bool EdgesReader::looks_like(std::string_view first_bytes) {
  const std::string_view header = first_bytes.substr(0, first_bytes.find('\n'));
  return header.find(kNames[1]) != std::string_view::npos;
}

void EdgesReader::read_header() {
  std::optional<std::string_view> line = lines_.next();
  if (!line) throw InputError(name() + ": empty; a recording starts with the header row sensor,rise_ticks,fall_ticks");
  if (line->starts_with(kEdgesByteOrderMark)) line->remove_prefix(kEdgesByteOrderMark.size());
  std::array<int, kColumns> found{};
  std::string_view rest = *line;
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    const std::size_t column = column_named(trimmed(rest.substr(0, comma)));
    column_of_field_.push_back(column);
    if (column < kColumns) {
      ++found[column];
      fields_needed_ = column_of_field_.size();
    }
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  for (std::size_t column = 0; column < kColumns; ++column) {
    if (found[column] == 1) continue;
    throw InputError(name() + ": line " + std::to_string(line_number()) + ": " +
                     (found[column] == 0 ? "no column '" : "more than one column '") + std::string(kNames[column]) +
                     "'; the header must have sensor,rise_ticks,fall_ticks, it is " + quoted(*line));
  }
}

std::optional<lighthouse::RawPulse> EdgesReader::next() {
  const std::optional<std::string_view> line = lines_.next();
  if (!line) return std::nullopt;
  std::array<std::int64_t, kColumns> value{};
  std::string_view rest = *line;
  for (std::size_t field = 0; field < fields_needed_; ++field) {
    const std::size_t comma = rest.find(',');
    const bool last_of_row = comma == std::string_view::npos;
    if (last_of_row != (field + 1 == column_of_field_.size())) fail(*line);
    const std::size_t column = column_of_field_[field];
    if (column < kColumns && !parse_whole(rest.substr(0, comma), value[column])) fail(*line);
    if (!last_of_row) rest.remove_prefix(comma + 1);
  }
  if (value[0] < 0) fail(*line);
  lighthouse::RawPulse pulse;
  pulse.sensor = static_cast<std::uint8_t>(std::min<std::int64_t>(value[0], 255));
  pulse.rise_ticks = ticks_.rise(value[1]);
  pulse.fall_ticks = ticks_.fall(value[2]);
  return pulse;
}

// Parses the row again, slowly, to find the invalid field.
void EdgesReader::fail(std::string_view line) const {
  const std::string place = name() + ": line " + std::to_string(line_number()) + ": ";
  const auto fields = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
  if (fields != column_of_field_.size()) {
    throw InputError(place + std::to_string(fields) + " fields where the header has " +
                     std::to_string(column_of_field_.size()) + "; remove or mend the line");
  }
  for (std::size_t field = 0; field < fields; ++field) {
    const std::size_t comma = line.find(',');
    const std::string_view text = line.substr(0, comma);
    std::int64_t value = 0;
    const std::size_t column = column_of_field_[field];
    if (column < kColumns && (!parse_whole(text, value) || (column == 0 && value < 0))) {
      throw InputError(place + "column '" + std::string(kNames[column]) + "': " + quoted(trimmed(text)) +
                       " is not a whole number; remove or mend the line");
    }
    if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
  }
  throw InputError(place + "not a row of the table; remove or mend the line");
}

}  // namespace pharos::host
