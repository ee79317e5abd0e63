// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/length_option.hpp"

#include <charconv>
#include <string_view>
#include <vector>

#include "host/support/input_error.hpp"
#include "pharos/base/capacity.hpp"

namespace pharos::tools {
namespace {

// Limit as in a target's table: no sensor is farther from another.
constexpr double kLongest_m = 12.0;

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

template <class Number>
bool read(std::string_view text, Number& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

calibrate::MeasuredLength parse_length(const std::string& text) {
  const auto fail = [&](const std::string& why) { throw host::InputError("--length " + text + ": " + why); };
  const std::vector<std::string_view> parts = split(text);
  unsigned a = 0;
  unsigned b = 0;
  calibrate::MeasuredLength length;
  if (parts.size() != 4 || !read(parts[0], a) || !read(parts[1], b) || !read(parts[2], length.length_m) ||
      !read(parts[3], length.sigma_m)) {
    fail("give SENSOR,SENSOR,METRES,SIGMA, such as 4,8,0.1288,0.00002");
  }
  if (a >= kMaxSensors || b >= kMaxSensors) fail("sensors are numbered 0 to 31");
  if (a == b) fail("a length needs two different sensors");
  if (!(length.length_m > 0.0 && length.length_m <= kLongest_m)) {
    fail("the length must be above 0 and at most 12 m; give metres, not millimetres");
  }
  if (!(length.sigma_m > 0.0 && length.sigma_m < length.length_m)) {
    fail("its sigma must be above 0 and below the length, in metres");
  }
  length.a = static_cast<std::uint8_t>(a);
  length.b = static_cast<std::uint8_t>(b);
  return length;
}

}  // namespace pharos::tools
