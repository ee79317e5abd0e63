// SPDX-License-Identifier: Apache-2.0
#include "host/stations/station_file.hpp"

#include <array>
#include <charconv>
#include <cstdio>

#include "host/support/exact_number.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/base/capacity.hpp"

namespace pharos::host {
namespace {

using lighthouse::RotorCalibration;

// Five times the largest value of any real station (gibbous phases are angles of a full circle).
constexpr Range kSmallAngle{-0.3, 0.3};
constexpr Range kCircle{-6.3, 6.3};
constexpr int kHexadecimal = 16;

struct Field {
  const char* key;
  double RotorCalibration::*member;
  Range range;
};
constexpr std::array<Field, 5> kFields{{
    {"phase_rad", &RotorCalibration::phase_rad, kSmallAngle},
    {"tilt_rad", &RotorCalibration::tilt_rad, kSmallAngle},
    {"curve_rad", &RotorCalibration::curve_rad, kSmallAngle},
    {"gibbous_phase_rad", &RotorCalibration::gibbous_phase_rad, kCircle},
    {"gibbous_magnitude_rad", &RotorCalibration::gibbous_magnitude_rad, kSmallAngle},
}};

}  // namespace

std::uint32_t read_station_id(const TomlTable& table, std::string_view key) {
  const std::string text = table.text(key);
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, kHexadecimal);
  if (error != std::errc{} || end != text.data() + text.size()) {
    table.fail(key, "must be up to eight hexadecimal digits, as printed on the station");
  }
  return id;
}

namespace {

StationEntry read_entry(const TomlTable& table) {
  StationEntry entry;
  if (table.has("slot")) entry.slot = static_cast<std::uint8_t>(table.integer("slot", 0, kMaxStations - 1));
  if (table.has("id")) entry.id = read_station_id(table, "id");
  if (!entry.id && !entry.slot) table.fail("id", "a [[station]] needs an id or a slot");
  entry.calibration.id = entry.id.value_or(0);
  for (const Field& field : kFields) {
    const auto values = table.vector_or<kAxes>(field.key, {}, field.range);
    for (std::size_t axis = 0; axis < values.size(); ++axis) {
      entry.calibration.rotor[axis].*field.member = values[axis];
    }
  }
  return entry;
}

}  // namespace

std::vector<StationEntry> read_stations(const TomlTable& root) {
  std::vector<StationEntry> entries;
  for (const TomlTable& table : root.tables("station")) entries.push_back(read_entry(table));
  return entries;
}

std::vector<StationEntry> read_station_file(const std::string& path) {
  const TomlTable root = TomlTable::parse_file(path);
  std::vector<StationEntry> entries = read_stations(root);
  root.reject_unknown();
  return entries;
}

bool is_plausible(const lighthouse::StationCalibration& station) {
  for (const Field& field : kFields) {
    for (const RotorCalibration& rotor : station.rotor) {
      const double value = rotor.*field.member;
      if (!(value >= field.range.low && value <= field.range.high)) return false;
    }
  }
  return true;
}

std::string station_text(const lighthouse::StationCalibration& station) {
  std::array<char, 16> id{};
  std::snprintf(id.data(), id.size(), "%08X", static_cast<unsigned>(station.id));
  std::string out = std::string("[[station]]\nid = \"") + id.data() + "\"\n";
  for (const Field& field : kFields) {
    out += std::string(field.key) + " = [" + exact_number(station.rotor[0].*field.member) + ", " +
           exact_number(station.rotor[1].*field.member) + "]\n";
  }
  return out;
}

}  // namespace pharos::host
