// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/libsurvive_config.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"

namespace pharos::convert {
namespace {

using host::InputError;
using Values = std::vector<std::string>;

constexpr std::size_t kLargestConfigFile = std::size_t{1} << 20U;
constexpr std::size_t kLargestText = 256;
constexpr double kLargestConfigField = 7.0;

/// Strings, and the signs between them.
class Tokens {
 public:
  Tokens(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(line_) + ": " + what);
  }
  /// The next sign; commas are blanks. '\0' at the end.
  char peek() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n' && c != ',') return c;
      if (c == '\n') ++line_;
      ++at_;
    }
    return '\0';
  }
  void take(char wanted) {
    if (peek() != wanted) fail(std::string("'") + wanted + "' is expected: not a configuration of libsurvive");
    ++at_;
  }
  /// A string in quotes, or a bare word or number.
  std::string word() {
    if (peek() != '"') return bare();
    ++at_;
    const std::size_t end = text_.find('"', at_);
    if (end == std::string_view::npos || end - at_ > kLargestText) fail("a string does not end");
    std::string out(text_.substr(at_, end - at_));
    at_ = end + 1;
    return out;
  }

 private:
  std::string bare() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(" \t\r\n,:[]{}\"").find(text_[at_]) == std::string_view::npos) ++at_;
    if (at_ == begin || at_ - begin > kLargestText) fail("a value is expected: not a configuration of libsurvive");
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

Values read_values(Tokens& in) {
  if (in.peek() != '[') return {in.word()};
  in.take('[');
  Values values;
  while (in.peek() != ']') values.push_back(in.word());
  in.take(']');
  return values;
}

class LighthouseEntry {
 public:
  LighthouseEntry(Tokens& in, std::string name) : in_(in), name_(std::move(name)) {
    in_.take('{');
    while (in_.peek() != '}') {
      const std::string key = in_.word();
      in_.take(':');
      values_[key] = read_values(in_);
    }
    in_.take('}');
  }

  network::Station station() const {
    network::Station station;
    station.generation = network::Generation::kLighthouse2;
    station.number = static_cast<std::uint8_t>(integer("mode", network::kMaxNetworkStations - 1));
    station.id = static_cast<std::uint32_t>(integer("id", 4294967295.0));
    for (const auto& [key, member] : {std::pair{"fcalphase", &lighthouse::PlaneCalibration::phase_rad},
                                      {"fcaltilt", &lighthouse::PlaneCalibration::tilt_rad},
                                      {"fcalcurve", &lighthouse::PlaneCalibration::curve},
                                      {"fcalgibpha", &lighthouse::PlaneCalibration::gibbous_phase_rad},
                                      {"fcalgibmag", &lighthouse::PlaneCalibration::gibbous_magnitude_rad},
                                      {"fcalogeephase", &lighthouse::PlaneCalibration::ogee_phase_rad},
                                      {"fcalogeemag", &lighthouse::PlaneCalibration::ogee_magnitude}}) {
      const std::vector<double> both = numbers(key, network::kPlanes, kLargestConfigField);
      for (std::size_t k = 0; k < both.size(); ++k) station.plane[k].*member = both[k];
    }
    read_pose(station);
    return station;
  }

 private:
  std::vector<double> numbers(const std::string& key, std::size_t count, double largest) const {
    const auto found = values_.find(key);
    if (found == values_.end() || found->second.size() != count) {
      in_.fail(name_ + ": " + key + ": " + std::to_string(count) + " numbers are expected");
    }
    std::vector<double> out;
    for (const std::string& text : found->second) {
      std::size_t used = 0;
      double value = std::numeric_limits<double>::quiet_NaN();
      try {
        value = std::stod(text, &used);
      } catch (const std::exception&) {
      }
      if (used != text.size() || !(std::abs(value) <= largest)) {
        in_.fail(name_ + ": " + key + ": " + host::quoted(text) + " is not a possible number");
      }
      out.push_back(value);
    }
    return out;
  }
  double integer(const std::string& key, double largest) const {
    const double value = numbers(key, 1, largest).front();
    if (value < 0.0 || value != std::floor(value)) in_.fail(name_ + ": " + key + ": a whole number is expected");
    return value;
  }
  void read_pose(network::Station& station) const {
    const auto set = values_.find("PositionSet");
    if (set == values_.end() || set->second != Values{"1"}) return;
    const std::vector<double> v = numbers("pose", 7, 1000.0);
    const Quaternion q(v[3], v[4], v[5], v[6]);
    if (!(std::abs(q.norm() - 1.0) < 0.01)) in_.fail(name_ + ": pose: the quaternion must have length 1");
    station.T_world_station = station_pose(q, Vector3(v[0], v[1], v[2]));
  }

  Tokens& in_;
  std::string name_;
  std::map<std::string, Values> values_;
};

}  // namespace

network::WorldFromStation station_pose(const Quaternion& q, const Vector3& t) {
  const Matrix3 R = q.normalized().toRotationMatrix();
  Matrix3 ours;
  ours << R.col(0), -R.col(1), -R.col(2);
  return {ours, t};
}

network::Stations read_libsurvive_config(const std::string& text, const std::string& name) {
  if (text.size() > kLargestConfigFile)
    throw InputError(name + ": larger than a mebibyte: not a configuration of libsurvive");
  Tokens in(text, name);
  const bool braces = in.peek() == '{';
  if (braces) in.take('{');
  network::Stations stations;
  while (in.peek() != '\0' && in.peek() != '}') {
    const std::string key = in.word();
    in.take(':');
    if (in.peek() != '{') {
      read_values(in);
      continue;
    }
    const network::Station station = LighthouseEntry(in, key).station();
    if (network::find_station(stations, station.number) != nullptr) {
      in.fail(key + ": channel " + std::to_string(station.number) + " comes twice");
    }
    stations.push_back(station);
  }
  if (braces) in.take('}');
  if (in.peek() != '\0') in.fail("something follows the end: not a configuration of libsurvive");
  return stations;
}

}  // namespace pharos::convert
