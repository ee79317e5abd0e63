// SPDX-License-Identifier: Apache-2.0
#include "host/table/lh2_light_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"

namespace pharos::host {
namespace {

constexpr std::array<const char*, 4> kLightColumns = {"sensor", "time_ticks", "data", "envelope"};
constexpr std::string_view kAnalyserTime = "Time[s]";
constexpr const char* kExpected =
    "; light is a table sensor,time_ticks,data,envelope or a logic analyser's Time[s],DATA[,ENVELOPE]";
constexpr std::int64_t kLargestLightReading = std::int64_t{1} << 52;
constexpr double kLargestTime_s = 1e7;

}  // namespace

Lh2LightReader::Lh2LightReader(ByteSource source) : lines_(std::move(source), LastLine::kDropUnfinished) {
  read_header();
}

void Lh2LightReader::split(std::string_view line) {
  fields_.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields_.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

void Lh2LightReader::read_header() {
  std::optional<std::string_view> line = lines_.next();
  if (!line) throw InputError(name() + ": empty" + kExpected);
  if (line->starts_with("\xEF\xBB\xBF")) line->remove_prefix(3);
  split(*line);
  header_fields_ = fields_.size();
  analyser_ = fields_.front() == kAnalyserTime;
  if (analyser_) {
    if (header_fields_ < 2 || header_fields_ > 3) {
      throw InputError(name() + ": line 1: " + std::to_string(header_fields_ - 1) +
                       " channels; export one receiver's data and envelope");
    }
    position_[kTime] = 0;
    position_[kData] = 1;
    if (header_fields_ == 3) position_[kEnvelope] = 2;
  } else {
    name_columns({fields_.begin(), fields_.end()});
  }
}

void Lh2LightReader::name_columns(const std::vector<std::string>& fields) {
  for (std::size_t column = 0; column < kColumns; ++column) {
    const auto found = std::find(fields.begin(), fields.end(), kLightColumns[column]);
    if (found == fields.end()) {
      throw InputError(name() + ": line " + std::to_string(lines_.line_number()) + ": no column '" +
                       kLightColumns[column] + "'" + kExpected);
    }
    position_[column] = static_cast<std::size_t>(found - fields.begin());
  }
}

void Lh2LightReader::fail(Column column, const char* what) const {
  throw InputError(name() + ": line " + std::to_string(lines_.line_number()) + ": column '" + kLightColumns[column] +
                   "': " + quoted(fields_[*position_[column]]) + " is not " + what + "; remove or mend the line");
}

std::int64_t Lh2LightReader::whole(Column column, std::int64_t minimum, std::int64_t maximum) const {
  const std::string_view text = fields_[*position_[column]];
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < minimum || value > maximum) {
    fail(column, maximum == 1 ? "0 or 1" : "a whole number in range");
  }
  return value;
}

std::int64_t Lh2LightReader::time_ticks() {
  if (!analyser_) return ticks_.rise(whole(kTime, -kLargestLightReading, kLargestLightReading));
  const std::string_view text = fields_[*position_[kTime]];
  double time_s = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time_s);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(time_s) <= kLargestTime_s)) {
    fail(kTime, "a time in seconds");
  }
  return std::llround(time_s * static_cast<double>(kTicksPerSecond));
}

std::optional<lighthouse::Lh2Edge> Lh2LightReader::next() {
  const std::optional<std::string_view> line = lines_.next();
  if (!line) return std::nullopt;
  split(*line);
  if (fields_.size() != header_fields_) {
    throw InputError(name() + ": line " + std::to_string(lines_.line_number()) + ": " + std::to_string(fields_.size()) +
                     " fields where the header has " + std::to_string(header_fields_) + "; remove or mend the line");
  }
  lighthouse::Lh2Edge edge;
  edge.time_ticks = time_ticks();
  if (position_[kSensor])
    edge.sensor = static_cast<std::uint8_t>(std::min<std::int64_t>(whole(kSensor, 0, 1 << 30), 255));
  edge.data = whole(kData, 0, 1) != 0;
  edge.light = position_[kEnvelope].has_value() && whole(kEnvelope, 0, 1) == 0;
  return edge;
}

}  // namespace pharos::host
