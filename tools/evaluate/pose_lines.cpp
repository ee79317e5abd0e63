// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/pose_lines.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"

namespace pharos::evaluate {
namespace {

constexpr double kNanosecond_s = 1e-9;
constexpr double kMinStamp_ns = 1e15;  // 16 digits: 1970-01-12
constexpr std::size_t kTumFields = 8;
constexpr const char* kBlank = " \t\r";

/// `text` as a number; it must be the whole text.
double number_of(std::string_view text, const std::string& where) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) {
    throw host::InputError(where + host::quoted(text) + " is not a number");
  }
  return value;
}

/// The numbers of a TUM line; none for a comment.
std::optional<std::array<double, kTumFields>> tum_numbers(std::string_view line, const std::string& where) {
  std::array<double, kTumFields> values{};
  std::size_t count = 0;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) break;
    line.remove_prefix(begin);
    if (count == 0 && line.front() == '#') return std::nullopt;
    const std::size_t length = std::min(line.find_first_of(kBlank), line.size());
    const double value = number_of(line.substr(0, length), where);
    if (count == kTumFields) {
      count = kTumFields + 1;
      break;
    }
    values[count++] = value;
    line.remove_prefix(length);
  }
  if (count == kTumFields) return values;
  throw host::InputError(where + "a TUM line has 8 numbers: timestamp tx ty tz qx qy qz qw");
}

}  // namespace

std::optional<RawRow> tum_row(std::string_view line, const std::string& where) {
  const auto v = tum_numbers(line, where);
  if (!v) return std::nullopt;
  RawRow row;
  row.time_s = (*v)[0];
  row.t = {(*v)[1], (*v)[2], (*v)[3]};
  row.q = Quaternion((*v)[7], (*v)[4], (*v)[5], (*v)[6]);
  return row;
}

std::optional<RawRow> euroc_row(std::string_view line, const std::string& where) {
  if (line.starts_with('#')) return std::nullopt;
  std::array<double, kTumFields> v{};
  for (std::size_t k = 0; k < v.size(); ++k) {
    const std::size_t comma = std::min(line.find(','), line.size());
    if (comma == 0) throw host::InputError(where + "8 numbers are wanted: ns, x, y, z, qw, qx, qy, qz");
    const std::size_t begin = std::min(line.find_first_not_of(kBlank), comma);
    v[k] = number_of(line.substr(begin, comma - begin), where);
    line.remove_prefix(std::min(comma + 1, line.size()));
  }
  if (v[0] < kMinStamp_ns) throw host::InputError(where + "it does not begin with nanoseconds since 1970");
  RawRow row;
  row.time_s = v[0] * kNanosecond_s;
  row.t = {v[1], v[2], v[3]};
  row.q = Quaternion(v[4], v[5], v[6], v[7]);
  return row;
}

bool looks_like_euroc(std::string_view head) {
  while (!head.empty()) {
    const std::string_view line = head.substr(0, head.find('\n'));
    head.remove_prefix(std::min(line.size() + 1, head.size()));
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin != std::string_view::npos && line[begin] != '#') return line.find(',') != std::string_view::npos;
  }
  return false;
}

}  // namespace pharos::evaluate
