// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/calibration_file.hpp"

#include <charconv>

#include "host/config/strict_toml.hpp"
#include "pharos/base/capacity.hpp"

namespace pharos::tools {
namespace {

using lighthouse::RotorCalibration;
using lighthouse::StationCalibration;

// Five times the largest value of any real station (gibbous phases are angles of a full circle).
constexpr host::Range kSmallAngle{-0.3, 0.3};
constexpr host::Range kCircle{-6.3, 6.3};
constexpr int kHexadecimal = 16;

std::uint32_t read_id(const host::TomlTable& table) {
  const std::string text = table.text("id");
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, kHexadecimal);
  if (error != std::errc{} || end != text.data() + text.size()) {
    table.fail("id", "must be up to eight hexadecimal digits, as printed on the station");
  }
  return id;
}

void read_rotors(const host::TomlTable& table, StationCalibration& calibration) {
  const auto read = [&](const char* key, double RotorCalibration::*field, host::Range range) {
    const auto values = table.vector_or<kAxes>(key, {}, range);
    for (std::size_t axis = 0; axis < values.size(); ++axis) calibration.rotor[axis].*field = values[axis];
  };
  read("phase_rad", &RotorCalibration::phase_rad, kSmallAngle);
  read("tilt_rad", &RotorCalibration::tilt_rad, kSmallAngle);
  read("curve_rad", &RotorCalibration::curve_rad, kSmallAngle);
  read("gibbous_phase_rad", &RotorCalibration::gibbous_phase_rad, kCircle);
  read("gibbous_magnitude_rad", &RotorCalibration::gibbous_magnitude_rad, kSmallAngle);
}

}  // namespace

CalibrationFile::CalibrationFile(const std::string& path) {
  const host::TomlTable root = host::TomlTable::parse_file(path);
  for (const host::TomlTable& table : root.tables("station")) {
    Entry entry;
    if (table.has("slot")) {
      entry.slot = static_cast<std::uint8_t>(table.integer("slot", 0, kMaxStations - 1));
    }
    if (table.has("id")) {
      entry.calibration.id = read_id(table);
    } else if (!entry.slot) {
      table.fail("id", "a [[station]] needs an id or a slot");
    }
    read_rotors(table, entry.calibration);
    entries_.push_back(entry);
  }
  root.reject_unknown();
  if (entries_.empty()) root.fail("station", "no [[station]] in the file");
}

const StationCalibration* CalibrationFile::find(std::uint8_t slot, const std::optional<std::uint32_t>& id) const {
  for (const Entry& entry : entries_) {
    if (entry.slot == slot) return &entry.calibration;
  }
  for (const Entry& entry : entries_) {
    if (!entry.slot && id && entry.calibration.id == *id) return &entry.calibration;
  }
  return nullptr;
}

}  // namespace pharos::tools
