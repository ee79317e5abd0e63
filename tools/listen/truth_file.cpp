// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/truth_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "host/support/input_error.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::tools {
namespace {

constexpr double kUsPerSecond = 1e6;
constexpr double kMaxNormError = 0.01;
// A time_s below this (1 January 2001) is not UTC but a recording's own counter.
constexpr double kEarliestUtc_s = 978'307'200.0;

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <class Number>
bool parse(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

TruthFile::TruthFile(const std::string& path) : path_(path), in_(path) {
  if (!in_) throw host::InputError(path + ": cannot be opened; check the path given with --truth");
}

void TruthFile::fail(const std::string& what) const {
  throw host::InputError(path_ + ":" + std::to_string(line_) + ": " + what);
}

void TruthFile::read_header(const std::string& line) {
  const std::vector<std::string_view> names = split(line);
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };
  const auto utime = find("utime");
  const auto time_s = find("time_s");
  if (!utime && !time_s) fail("no column utime or time_s; a truth file has utime,qw,qx,qy,qz,tx_m,ty_m,tz_m");
  time_in_seconds_ = !utime;
  time_column_ = utime ? *utime : *time_s;
  station_column_ = find("station");
  constexpr std::array<std::string_view, 7> kPose{"qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"};
  for (std::size_t i = 0; i < kPose.size(); ++i) {
    const auto column = find(kPose[i]);
    if (!column) fail("no column " + std::string(kPose[i]));
    pose_columns_[i] = *column;
  }
  has_header_ = true;
}

void TruthFile::read_row(const std::string& line) {
  const std::vector<std::string_view> fields = split(line);
  const auto field = [&](std::size_t column) {
    if (column >= fields.size()) fail("too few fields");
    return fields[column];
  };
  Row row;
  if (time_in_seconds_) {
    double seconds = 0.0;
    if (!parse(field(time_column_), seconds)) fail("time_s is not a number");
    if (seconds < kEarliestUtc_s)
      fail("time_s is not UTC (seconds since 1970); poses on LCM cannot be compared with it");
    row.utc_us = static_cast<std::int64_t>(std::llround(seconds * kUsPerSecond));
  } else if (!parse(field(time_column_), row.utc_us)) {
    fail("utime is not an integer");
  }
  int station = 0;
  if (station_column_ && !parse(field(*station_column_), station)) fail("station is not an integer");
  if (station < 0 || station >= static_cast<int>(kStations)) fail("station must be 0 or 1");
  std::array<double, 7> pose{};
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (!parse(field(pose_columns_[i]), pose[i]) || !std::isfinite(pose[i])) fail("a pose field is not a number");
  }
  row.orientation = Quaternion(pose[0], pose[1], pose[2], pose[3]);
  if (std::abs(row.orientation.norm() - 1.0) > kMaxNormError) fail("the quaternion has not length 1");
  row.orientation.normalize();
  row.position_m = Vector3(pose[4], pose[5], pose[6]);
  std::vector<Row>& rows = rows_[static_cast<std::size_t>(station)];
  if (!rows.empty() && row.utc_us <= rows.back().utc_us) fail("times must grow from row to row");
  rows.push_back(row);
}

void TruthFile::read_new_rows() {
  in_.clear();  // the file may have grown since its end was reached
  for (std::string part; std::getline(in_, part);) {
    unfinished_ += part;
    if (in_.eof()) return;
    ++line_;
    const std::string line = std::move(unfinished_);
    unfinished_.clear();
    if (has_header_) {
      read_row(line);
    } else {
      read_header(line);
    }
  }
}

std::optional<LighthouseFromBody> TruthFile::at(int station, std::int64_t utc_us) {
  if (station < 0 || station >= static_cast<int>(kStations)) return std::nullopt;
  const std::vector<Row>& rows = rows_[static_cast<std::size_t>(station)];
  if (rows.empty() || rows.back().utc_us < utc_us) read_new_rows();
  const auto after = std::lower_bound(rows.begin(), rows.end(), utc_us,
                                      [](const Row& row, std::int64_t time) { return row.utc_us < time; });
  if (after == rows.end() || (after == rows.begin() && after->utc_us != utc_us)) return std::nullopt;
  if (after->utc_us == utc_us) return LighthouseFromBody{after->orientation.toRotationMatrix(), after->position_m};
  const Row& before = *(after - 1);
  const double fraction =
      static_cast<double>(utc_us - before.utc_us) / static_cast<double>(after->utc_us - before.utc_us);
  return LighthouseFromBody{before.orientation.slerp(fraction, after->orientation).toRotationMatrix(),
                            before.position_m + fraction * (after->position_m - before.position_m)};
}

}  // namespace pharos::tools
