// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/system_config.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "host/support/input_error.hpp"

namespace pharos::convert {
namespace {

using host::InputError;
using network::Station;

constexpr double kLargestPosition_m = 1000.0;
constexpr double kLargestField = 7.0;  // phases are angles of a full circle
constexpr double kRotationTolerance = 0.01;
constexpr std::size_t kLargestFile = std::size_t{1} << 20U;
constexpr int kDeepestNesting = 32;

/// One line, whatever the parser says.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, ' ');
  return text;
}

class Config {
 public:
  Config(const YAML::Node& root, const std::string& name) : root_(root), name_(name) {}

  network::Stations stations() const {
    const int generation = static_cast<int>(number(root_["systemType"], "systemType"));
    if (generation != 1 && generation != 2) fail("systemType", "must be 1 or 2");
    std::set<int> numbers;
    collect(root_["calibs"], "calibs", numbers);
    collect(root_["geos"], "geos", numbers);
    if (numbers.empty()) throw InputError(name_ + ": no base station: neither calibs nor geos has an entry");
    network::Stations out;
    for (const int at : numbers) {
      Station station;
      station.number = static_cast<std::uint8_t>(at);
      station.generation = static_cast<network::Generation>(generation);
      const std::string key = std::to_string(at);
      if (const YAML::Node calib = entry(root_["calibs"], at)) read_calib(calib, "calibs." + key, station);
      if (const YAML::Node geo = entry(root_["geos"], at)) read_geo(geo, "geos." + key, station);
      out.push_back(station);
    }
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError(name_ + ": " + key + ": " + what);
  }
  double number(const YAML::Node& node, const std::string& key) const {
    double value = 0.0;
    if (!node || !node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      fail(key, "a number is expected");
    }
    return value;
  }
  static YAML::Node entry(const YAML::Node& map, int number) {
    if (!map || !map.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
    return map[std::to_string(number)];
  }
  void collect(const YAML::Node& map, const std::string& key, std::set<int>& numbers) const {
    if (!map || map.IsNull()) return;
    if (!map.IsMap()) fail(key, "a table by base station is expected");
    for (const auto& pair : map) {
      const double value = number(pair.first, key);
      if (value != std::floor(value) || value < 0.0 || value >= network::kMaxNetworkStations) {
        fail(key, "a base station is a number from 0 to 15");
      }
      numbers.insert(static_cast<int>(value));
    }
  }
  void read_calib(const YAML::Node& calib, const std::string& key, Station& station) const {
    if (!calib.IsMap()) fail(key, "a table is expected");
    if (calib["uid"]) {
      const double id = number(calib["uid"], key + ".uid");
      if (id < 0.0 || id > 4294967295.0 || id != std::floor(id)) fail(key + ".uid", "must be a number of 32 bits");
      station.id = static_cast<std::uint32_t>(id);
    }
    const YAML::Node sweeps = calib["sweeps"];
    if (!sweeps || !sweeps.IsSequence() || sweeps.size() != network::kPlanes) fail(key, "two sweeps are expected");
    for (std::size_t k = 0; k < network::kPlanes; ++k) {
      const YAML::Node sweep = sweeps[k];
      const std::string place = key + ".sweeps." + std::to_string(k);
      if (!sweep.IsMap()) fail(place, "a table is expected");
      lighthouse::PlaneCalibration& plane = station.plane[k];
      for (const auto& [name, value] : {std::pair{"phase", &plane.phase_rad},
                                        {"tilt", &plane.tilt_rad},
                                        {"curve", &plane.curve},
                                        {"gibphase", &plane.gibbous_phase_rad},
                                        {"gibmag", &plane.gibbous_magnitude_rad},
                                        {"ogeephase", &plane.ogee_phase_rad},
                                        {"ogeemag", &plane.ogee_magnitude}}) {
        *value = number(sweep[name], place + "." + name);
        if (std::abs(*value) > kLargestField) fail(place + "." + name, "no station has such a value");
      }
      if (station.generation == network::Generation::kLighthouse1) plane.ogee_phase_rad = plane.ogee_magnitude = 0.0;
    }
  }
  void read_geo(const YAML::Node& geo, const std::string& key, Station& station) const {
    if (!geo.IsMap()) fail(key, "a table is expected");
    const YAML::Node origin = geo["origin"], rotation = geo["rotation"];
    if (!origin || !origin.IsSequence() || origin.size() != 3) fail(key + ".origin", "three numbers are expected");
    if (!rotation || !rotation.IsSequence() || rotation.size() != 3) fail(key + ".rotation", "three rows are expected");
    Vector3 t;
    Matrix3 R;  // columns: x ahead, y left, z up
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      t[row] = number(origin[i], key + ".origin");
      const YAML::Node values = rotation[i];
      if (!values.IsSequence() || values.size() != 3) fail(key + ".rotation", "three rows of three are expected");
      for (std::size_t j = 0; j < 3; ++j) R(row, static_cast<Eigen::Index>(j)) = number(values[j], key + ".rotation");
    }
    if (t.cwiseAbs().maxCoeff() > kLargestPosition_m) fail(key + ".origin", "is beyond a kilometre; give metres");
    const bool rotates =
        (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < kRotationTolerance && R.determinant() > 0.0;
    if (!rotates) fail(key + ".rotation", "is no rotation matrix");
    Matrix3 ours;  // x right, y down, z ahead
    ours << -R.col(1), -R.col(2), R.col(0);
    station.T_world_station = network::WorldFromStation{orthonormalised(ours), t};
  }

  const YAML::Node& root_;
  const std::string& name_;
};

/// The parser goes into itself for each level: a text of brackets alone would exhaust the stack.
void require_shallow(const std::string& text, const std::string& name) {
  int depth = 0;
  std::size_t indent = 0, levels = 0, column = 0;
  bool leading = true;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (c == '\n') {
      leading = true;
      column = levels = 0;
    } else if (leading) {
      // "- - - -" nests once a dash, spaces once or not at all.
      if (c == '-' || c == '?' || c == ':') ++levels;
      if (c == ' ' || c == '-' || c == '?' || c == ':') {
        ++column;
      } else {
        leading = false;
      }
      indent = std::max(indent, column);
    }
    if (depth > kDeepestNesting || levels > kDeepestNesting || indent > 8U * kDeepestNesting) {
      throw InputError(name + ": nested too deeply: not a system configuration");
    }
  }
}

}  // namespace

network::Stations read_system_config(const std::string& text, const std::string& name) {
  if (text.size() > kLargestFile) throw InputError(name + ": larger than a mebibyte: not a system configuration");
  if (text.find('\0') != std::string::npos) throw InputError(name + ": binary data, not YAML");
  require_shallow(text, name);
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap() || !root["systemType"]) {
      throw InputError(name + ": not a lighthouse system configuration (no systemType)");
    }
    return Config(root, name).stations();
  } catch (const YAML::Exception& error) {
    throw InputError(name + ": " + one_line(error.what()));
  }
}

}  // namespace pharos::convert
