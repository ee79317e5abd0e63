// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/crazyflie_log.hpp"

#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::convert {
namespace {

constexpr std::uint8_t kMagic = 0xBC;
constexpr unsigned kVersion = 2;
constexpr std::size_t kChecksumBytes = 4;
constexpr std::size_t kLongestName = 128;
constexpr double kMicrosecond_s = 1e-6;
constexpr double kStandardGravity_m_s2 = 9.80665;
constexpr double kLargestAngle_rad = 1.5;
constexpr double kLargestBeam_m = 1e4;
constexpr double kTicks = 4294967296.0;  // a counter of 32 bits wraps
constexpr int kMaxSensorNumber = 31;
constexpr int kMaxStationNumber = 15;

/// Size of a variable of Python's struct; 0 for a letter that a log does not use.
std::size_t size_of(char letter) {
  switch (letter) {
    case 'b':
    case 'B':
      return 1;
    case 'h':
    case 'H':
      return 2;
    case 'i':
    case 'I':
    case 'f':
      return 4;
    case 'q':
    case 'Q':
    case 'd':
      return 8;
    default:
      return 0;
  }
}

/// Little-endian fields, one after the other.
class Bytes {
 public:
  Bytes(std::span<const std::uint8_t> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  std::size_t at() const { return at_; }
  bool ended() const { return at_ == bytes_.size(); }
  [[noreturn]] void fail(const std::string& what) const {
    throw host::InputError(name_ + ": byte " + std::to_string(at_) + ": " + what);
  }
  std::uint64_t integer(std::size_t size) {
    require(size);
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8U | bytes_[at_ + i];
    at_ += size;
    return value;
  }
  double number(char letter) {
    const std::size_t size = size_of(letter);
    const std::uint64_t raw = integer(size);
    if (letter == 'f') return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
    if (letter == 'd') return std::bit_cast<double>(raw);
    const bool is_signed = letter == 'b' || letter == 'h' || letter == 'i' || letter == 'q';
    if (!is_signed) return static_cast<double>(raw);
    const unsigned unused = 64U - 8U * static_cast<unsigned>(size);
    return static_cast<double>(static_cast<std::int64_t>(raw << unused) >> unused);
  }
  std::string text() {
    std::string out;
    while (true) {
      require(1);
      const auto c = static_cast<char>(bytes_[at_++]);
      if (c == '\0') return out;
      if (c < ' ' || c > '~' || out.size() == kLongestName) fail("a name is expected here: not a log of a Crazyflie");
      out += c;
    }
  }

 private:
  void require(std::size_t size) const {
    if (bytes_.size() - at_ < size) fail("the log ends within an entry: it is cut off");
  }

  std::span<const std::uint8_t> bytes_;
  std::string name_;
  std::size_t at_ = 0;
};

struct Variable {
  std::string name;
  char letter = 'B';
};

struct EventType {
  std::string name;
  std::vector<Variable> variables;
};

/// Values of one event.
struct LoggedEvent {
  double time_s = 0.0;
  std::vector<double> values;  // as EventType::variables
};

EventType read_type(Bytes& in) {
  EventType type;
  type.name = in.text();
  const std::uint64_t count = in.integer(2);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string text = in.text();  // name(t)
    const std::size_t length = text.size();
    if (length < 4 || text[length - 3] != '(' || text[length - 1] != ')' || size_of(text[length - 2]) == 0) {
      in.fail("event '" + type.name + "': variable '" + text + "' is not of the form name(t) with a known type t");
    }
    type.variables.push_back({text.substr(0, length - 3), text[length - 2]});
  }
  return type;
}

/// Places of an event's variables by name; none where the log has no such event.
class Columns {
 public:
  Columns(const std::map<std::uint16_t, EventType>& types, const std::string& event,
          const std::vector<std::string>& names, const std::string& file, bool required = true) {
    for (const auto& [id, type] : types) {
      if (type.name != event) continue;
      id_ = id;
      for (const std::string& name : names) {
        const std::optional<std::size_t> place = place_of(type, name);
        if (!place && required) {
          throw host::InputError(file + ": event '" + event + "' has no variable '" + name + "'");
        }
        if (!place) {
          id_.reset();
          return;
        }
        place_.push_back(*place);
      }
    }
  }
  bool is(std::uint16_t id) const { return id_ == id; }
  double operator()(const LoggedEvent& event, std::size_t column) const { return event.values[place_[column]]; }

 private:
  static std::optional<std::size_t> place_of(const EventType& type, const std::string& name) {
    for (std::size_t i = 0; i < type.variables.size(); ++i) {
      if (type.variables[i].name == name) return i;
    }
    return std::nullopt;
  }

  std::optional<std::uint16_t> id_;
  std::vector<std::size_t> place_;
};

class CrazyflieReader {
 public:
  CrazyflieReader(std::span<const std::uint8_t> bytes, const std::string& name) : in_(bytes, name), name_(name) {
    read_header();
  }

  CrazyflieLog read() {
    const Columns angle(types_, "lhAngle", {"sensor", "basestation", "sweep", "angle"}, name_);
    const Columns beam(types_, "lhCrossingBeam", {"x", "y", "z", "delta"}, name_);
    const Columns imu(types_, "fixedFrequency", {"gyro.x", "gyro.y", "gyro.z", "acc.x", "acc.y", "acc.z"}, name_,
                      false);
    const Columns frame(types_, "lhUartFrame", {"sensor", "timestamp2FPGA"}, name_, false);
    const Columns marker(types_, "activeMarkerModeChanged", {"mode"}, name_);
    while (!in_.ended()) {
      const auto id = static_cast<std::uint16_t>(in_.integer(2));
      const LoggedEvent event = read_event(id);
      if (angle.is(id)) take_angle(angle, event);
      if (beam.is(id)) take_beam(beam, event);
      if (frame.is(id)) take_frame(frame, event);
      if (imu.is(id)) take_imu(imu, event);
      if (marker.is(id)) log_.events.push_back({event.time_s, marker(event, 0) > 0.0 ? "markers_on" : "markers_off"});
    }
    return std::move(log_);
  }

 private:
  void read_header() {
    in_.integer(1);  // the magic byte
    const std::uint64_t version = in_.integer(2);
    if (version != kVersion) {
      throw host::InputError(name_ + ": a log of version " + std::to_string(version) + "; only version 2 is known");
    }
    const std::uint64_t count = in_.integer(2);
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto id = static_cast<std::uint16_t>(in_.integer(2));
      EventType type = read_type(in_);
      if (!types_.emplace(id, std::move(type)).second) {
        in_.fail("event type " + std::to_string(id) + " is declared twice");
      }
    }
  }
  LoggedEvent read_event(std::uint16_t id) {
    const auto found = types_.find(id);
    if (found == types_.end()) in_.fail("an event of type " + std::to_string(id) + ", which the log does not declare");
    LoggedEvent event;
    event.time_s = static_cast<double>(in_.integer(8)) * kMicrosecond_s;
    for (const Variable& variable : found->second.variables) event.values.push_back(in_.number(variable.letter));
    return event;
  }
  void take_angle(const Columns& column, const LoggedEvent& event) {
    const double sensor = column(event, 0), station = column(event, 1), plane = column(event, 2);
    const double angle_rad = column(event, 3);
    const bool usable = sensor >= 0 && sensor <= kMaxSensorNumber && station >= 0 && station <= kMaxStationNumber &&
                        (plane == 0.0 || plane == 1.0) && std::abs(angle_rad) < kLargestAngle_rad;
    if (!usable) {
      ++log_.unusable;
      return;
    }
    log_.angles.push_back({event.time_s, static_cast<std::uint8_t>(sensor), static_cast<std::uint8_t>(station),
                           static_cast<std::uint8_t>(plane), angle_rad});
  }
  void take_beam(const Columns& column, const LoggedEvent& event) {
    const CrossingBeam beam{event.time_s, {column(event, 0), column(event, 1), column(event, 2)}, column(event, 3)};
    const bool usable = beam.position_m.allFinite() && std::isfinite(beam.delta_m) &&
                        beam.position_m.cwiseAbs().maxCoeff() < kLargestBeam_m;
    if (usable) {
      log_.crossing_beams.push_back(beam);
    } else {
      ++log_.unusable;
    }
  }
  void take_frame(const Columns& column, const LoggedEvent& event) {
    const double sensor = column(event, 0), stamp = column(event, 1);
    if (!(sensor >= 0 && sensor <= kMaxSensorNumber && stamp >= 0 && stamp < kTicks)) return;
    log_.frames.push_back({event.time_s, static_cast<std::uint8_t>(sensor), static_cast<std::uint32_t>(stamp)});
  }
  void take_imu(const Columns& column, const LoggedEvent& event) {
    ImuSample sample;
    sample.time_s = event.time_s;
    for (int k = 0; k < 3; ++k) {
      sample.gyro_rad_s[k] = column(event, static_cast<std::size_t>(k)) * kRadPerDeg;
      sample.acceleration_m_s2[k] = column(event, static_cast<std::size_t>(k + 3)) * kStandardGravity_m_s2;
    }
    if (sample.gyro_rad_s.allFinite() && sample.acceleration_m_s2.allFinite()) {
      log_.imu.push_back(sample);
    } else {
      ++log_.unusable;
    }
  }

  Bytes in_;
  const std::string& name_;
  std::map<std::uint16_t, EventType> types_;
  CrazyflieLog log_;
};

}  // namespace

CrazyflieLog read_crazyflie_log(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.empty()) throw host::InputError(name + ": the file is empty");
  if (bytes.front() != kMagic) throw host::InputError(name + ": not a log of a Crazyflie (its first byte is 0xBC)");
  if (bytes.size() <= kChecksumBytes) throw host::InputError(name + ": the log is cut off: it has no checksum");
  const auto body = bytes.first(bytes.size() - kChecksumBytes);
  std::uint32_t told = 0;
  for (std::size_t i = kChecksumBytes; i-- > 0;) told = told << 8U | bytes[body.size() + i];
  if (wire::crc32(body) != told) {
    throw host::InputError(name + ": its checksum does not match: the log is broken or cut off; copy it again");
  }
  return CrazyflieReader(body, name).read();
}

}  // namespace pharos::convert
