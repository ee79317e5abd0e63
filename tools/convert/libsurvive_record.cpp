// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/libsurvive_record.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "host/support/input_error.hpp"
#include "host/table/line_reader.hpp"
#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"
#include "tools/convert/crazyflie_sweeps.hpp"
#include "tools/convert/libsurvive_config.hpp"
#include "tools/convert/lower_envelope.hpp"

namespace pharos::convert {
namespace {

constexpr double kTick_s = 1.0 / 48e6;
constexpr double kGravity_m_s2 = 9.80665;
constexpr double kMaxSyncTurns = 4.0;  // a rotor is even enough to count on without a sync
// Where the record does not tell: 8 g and 2000 deg/s over 16 bits.
constexpr double kDefaultAcceleration_g = 8.0 / 32768.0;
constexpr double kDefaultGyro_rad_s = 2000.0 / 32768.0 * kRadPerDeg;
constexpr std::size_t kForeignLines = 200;  // without one of ours: another kind of file
constexpr double kLargestSensorPosition_m = 12.0;
constexpr double kLargestTime_s = 1e9;

/// Blank-separated words of a line, from left to right.
class Words {
 public:
  Words(std::string_view line, std::string where) : rest_(line), where_(std::move(where)) {}

  [[noreturn]] void fail(const std::string& what) const { throw host::InputError(where_ + what); }
  std::string_view next() {
    const std::size_t begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
    rest_.remove_prefix(begin);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t"));
    rest_.remove_prefix(word.size());
    return word;
  }
  std::string_view rest() const { return rest_; }
  double number() {
    const std::string_view word = next();
    double value = std::numeric_limits<double>::quiet_NaN();
    const char* begin = word.data() + (!word.empty() && word.front() == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
      fail("a number is expected instead of " + host::quoted(word));
    }
    return value;
  }
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    const std::string_view word = next();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || end != word.data() + word.size() || value < low || value > high) {
      fail("a whole number from " + std::to_string(low) + " to " + std::to_string(high) + " is expected instead of " +
           host::quoted(word));
    }
    return value;
  }

 private:
  std::string_view rest_;
  std::string where_;
};

constexpr double kWrap_s = 4294967296.0 * kTick_s;
// A hit whose counter differs by more from those around was recorded before the receiver's clock was set.
constexpr double kPlausibleDelay_s = 1.0;

struct TimedHit {
  double arrived_s = 0.0;
  std::uint32_t ticks = 0;
  LightHit hit;
};

struct Device {
  RecordedDevice out;
  std::array<std::optional<std::uint32_t>, 16> sync;
  std::vector<TimedHit> hits;
  double acceleration_g = kDefaultAcceleration_g;
  double gyro_rad_s = kDefaultGyro_rad_s;
};

Vector3 vector_of(const nlohmann::json& json, const Words& in) {
  if (!json.is_array() || json.size() != 3) in.fail("CONFIG: a point of three numbers is expected");
  Vector3 v;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!json[k].is_number()) in.fail("CONFIG: a point of three numbers is expected");
    v[static_cast<Eigen::Index>(k)] = json[k].get<double>();
  }
  if (!v.allFinite()) in.fail("CONFIG: a point of three numbers is expected");
  return v;
}

// A device's description of itself: as JSON nests little, so may this.
nlohmann::json parse_config(std::string_view text, const Words& in) {
  int depth = 0;
  for (const char c : text) {
    depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    if (depth > 32) in.fail("CONFIG: nested too deeply");
  }
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) in.fail("CONFIG: not JSON");
  return json;
}

Target target_of(const nlohmann::json& json, const Words& in) {
  const auto config = json.find("lighthouse_config");
  if (!json.is_object() || config == json.end() || !config->is_object() || !config->contains("modelPoints")) {
    in.fail("CONFIG: no lighthouse_config with modelPoints");
  }
  const nlohmann::json& points = (*config)["modelPoints"];
  const nlohmann::json normals = config->value("modelNormals", nlohmann::json::array());
  if (!points.is_array() || points.size() > kMaxSensors) in.fail("CONFIG: modelPoints: up to 32 points are expected");
  Target target;
  for (std::size_t i = 0; i < points.size(); ++i) {
    SensorPlacement sensor;
    sensor.sensor = static_cast<std::uint8_t>(i);
    sensor.position_m = vector_of(points[i], in);
    if (sensor.position_m.cwiseAbs().maxCoeff() > kLargestSensorPosition_m) in.fail("CONFIG: a point is beyond 12 m");
    if (normals.is_array() && i < normals.size()) {
      const Vector3 normal = vector_of(normals[i], in);
      if (std::abs(normal.norm() - 1.0) < 0.05) sensor.normal = normal.normalized();
    }
    target.push_back(sensor);
  }
  return target;
}

class RecordReader {
 public:
  explicit RecordReader(host::ByteSource source) : lines_(std::move(source), host::LastLine::kDropUnfinished) {}

  LibsurviveRecord read() {
    while (const std::optional<std::string_view> line = lines_.next()) {
      take(*line);
      if (lines_.line_number() > kForeignLines && ours_ == 0) break;
    }
    if (ours_ == 0)
      throw host::InputError(lines_.name() + ": not a record of libsurvive (lines `time device kind ...`)");
    LibsurviveRecord record;
    record.external = std::move(external_);
    record.cut_off = lines_.ended_unfinished();
    std::size_t hits = 0;
    for (auto& [name, device] : devices_) {
      hits += device.hits.size();
      if (device.hits.empty() && device.out.target.empty()) continue;
      put_on_log_clock(device);
      device.out.name = name;
      record.devices.emplace(name, std::move(device.out));
    }
    if (hits == 0 && lh1_ > 0) {
      throw host::InputError(lines_.name() + ": holds light of Lighthouse 1.0 only (C lines), which is not read here");
    }
    return record;
  }

 private:
  void take(std::string_view line) {
    Words in(line, lines_.name() + ": line " + std::to_string(lines_.line_number()) + ": ");
    const std::string_view stamp = in.next();
    double time_s = 0.0;
    const auto [end, error] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), time_s);
    if (stamp.empty() || error != std::errc{} || end != stamp.data() + stamp.size()) return;
    if (!(std::abs(time_s) < kLargestTime_s)) return;
    const std::string name(in.next());
    const std::string_view kind = in.next();
    if (kind == "LOG") ++ours_, take_log(in);
    if (kind == "W") ++ours_, take_hit(time_s, name, in);
    if (kind == "Y") ++ours_, take_sync(name, in);
    if (kind == "i") ++ours_, take_imu(time_s, name, in);
    if (kind == "C") ++ours_, ++lh1_;
    if (kind == "CONFIG") ++ours_, take_config(name, in);
    if (kind == "EXTERNAL_POSE") ++ours_, take_external(time_s, name, in);
  }
  // INFO LOG Setting KN0 gyro scale 3(0.000244) acc scale 2(0.001065): the first is of the acceleration (g a count),
  // the second of the gyro (rad/s a count), whatever the words say: the devices' own gravity shows it.
  void take_log(Words& in) {
    std::string_view rest = in.rest();
    if (rest.find("Setting ") == std::string_view::npos) return;
    const std::size_t first = rest.find("gyro scale "), second = rest.find("acc scale ");
    if (first == std::string_view::npos || second == std::string_view::npos) return;
    const auto in_brackets = [&](std::size_t from) {
      const std::size_t open = rest.find('(', from);
      double value = 0.0;
      if (open != std::string_view::npos) std::from_chars(rest.data() + open + 1, rest.data() + rest.size(), value);
      return value;
    };
    const double acceleration_g = in_brackets(first), gyro_rad_s = in_brackets(second);
    for (auto& [name, device] : devices_) {
      if (rest.find(name) == std::string_view::npos || !(acceleration_g > 0.0) || !(gyro_rad_s > 0.0)) continue;
      device.acceleration_g = acceleration_g;
      device.gyro_rad_s = gyro_rad_s;
    }
  }
  void take_sync(const std::string& name, Words& in) {
    const auto channel = static_cast<std::size_t>(in.integer(0, 15));
    devices_[name].sync[channel] = static_cast<std::uint32_t>(in.integer(0, UINT32_MAX));
  }
  void take_hit(double time_s, const std::string& name, Words& in) {
    const auto channel = static_cast<std::uint8_t>(in.integer(0, 15));
    const auto sensor = static_cast<std::uint8_t>(in.integer(0, kMaxSensors - 1));
    Device& device = devices_[name];
    const auto ticks = static_cast<std::uint32_t>(in.integer(0, UINT32_MAX));
    const double turn_ticks = rotor_period_s(2, channel) / kTick_s;
    const auto& sync = device.sync[channel];
    const double turns = sync ? static_cast<double>(static_cast<std::int32_t>(ticks - *sync)) / turn_ticks : -1.0;
    if (turns < 0.0 || turns > kMaxSyncTurns) {
      ++device.out.without_sync;
      return;
    }
    const double part = turns - std::floor(turns);
    LightHit hit;
    hit.station = channel;
    hit.sensor = sensor;
    hit.plane = part < 0.5 ? 0 : 1;
    hit.theta_rad = kTwoPi * part - kPi + (hit.plane == 0 ? kPi / 3 : -kPi / 3);
    device.hits.push_back({time_s, ticks, hit});
  }
  void take_imu(double time_s, const std::string& name, Words& in) {
    const std::int64_t mask = in.integer(0, 7);
    in.integer(0, UINT32_MAX);
    std::array<double, 6> value{};
    for (double& v : value) v = in.number();
    if ((mask & 3) != 3) return;
    Device& device = devices_[name];
    ImuSample sample;
    sample.time_s = time_s;
    for (int k = 0; k < 3; ++k) {
      sample.acceleration_m_s2[k] = value[static_cast<std::size_t>(k)] * device.acceleration_g * kGravity_m_s2;
      sample.gyro_rad_s[k] = value[static_cast<std::size_t>(k + 3)] * device.gyro_rad_s;
    }
    device.out.imu.push_back(sample);
  }
  void take_config(const std::string& name, Words& in) {
    devices_[name].out.target = target_of(parse_config(in.rest(), in), in);
  }
  void take_external(double time_s, const std::string& name, Words& in) {
    ExternalPose pose;
    pose.time_s = time_s;
    pose.device = name;
    for (int k = 0; k < 3; ++k) pose.t[k] = in.number();
    const double w = in.number(), x = in.number(), y = in.number(), z = in.number();
    pose.q = Quaternion(w, x, y, z);
    if (std::abs(pose.q.norm() - 1.0) < 0.01) external_.push_back(pose);
  }
  // The counter wraps every 89 s: of all its turns the one that agrees with the others.
  static void put_on_log_clock(Device& device) {
    std::vector<double> delays_s;
    for (const TimedHit& hit : device.hits) {
      double delay_s = hit.arrived_s - static_cast<double>(hit.ticks) * kTick_s;
      if (!delays_s.empty()) delay_s -= std::round((delay_s - delays_s.back()) / kWrap_s) * kWrap_s;
      delays_s.push_back(delay_s);
    }
    if (delays_s.empty()) return;
    std::vector<double> sorted = delays_s;
    std::nth_element(sorted.begin(), sorted.begin() + std::ssize(sorted) / 2, sorted.end());
    const double usual_s = sorted[sorted.size() / 2];
    std::vector<double> arrived_s, plausible_s;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < delays_s.size(); ++i) {
      const double delay_s = delays_s[i] - std::round((delays_s[i] - usual_s) / kWrap_s) * kWrap_s;
      if (std::abs(delay_s - usual_s) > kPlausibleDelay_s) continue;
      arrived_s.push_back(device.hits[i].arrived_s);
      plausible_s.push_back(delay_s);
      kept.push_back(i);
    }
    device.out.without_sync += device.hits.size() - kept.size();
    const std::vector<double> min_s = lower_envelope(arrived_s, plausible_s);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      LightHit hit = device.hits[kept[k]].hit;
      hit.time_s = arrived_s[k] - plausible_s[k] + min_s[k];
      device.out.hits.push_back(hit);
    }
    std::stable_sort(device.out.hits.begin(), device.out.hits.end(),
                     [](const LightHit& a, const LightHit& b) { return a.time_s < b.time_s; });
  }

  host::LineReader lines_;
  std::map<std::string, Device> devices_;
  std::vector<ExternalPose> external_;
  std::size_t ours_ = 0;
  std::size_t lh1_ = 0;
};

}  // namespace

LibsurviveRecord read_libsurvive_record(host::ByteSource source) { return RecordReader(std::move(source)).read(); }

void place_stations(const LibsurviveRecord& record, network::Stations& stations) {
  for (const ExternalPose& pose : record.external) {
    for (network::Station& station : stations) {
      if (pose.device != "previous_LH" + std::to_string(station.number)) continue;
      station.T_world_station = station_pose(pose.q, pose.t);
    }
  }
}

}  // namespace pharos::convert
