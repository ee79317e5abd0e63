// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/calibration_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "host/config/strict_toml.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {
namespace {

using lighthouse::RotorCalibration;
using lighthouse::StationCalibration;

constexpr const char* kHeading =
    "# Calibrations that stations sent of themselves and that pharosd accepted. Written by pharosd; delete the file to "
    "forget them.\n";

struct Field {
  const char* key;
  double RotorCalibration::*member;
};
constexpr std::array<Field, 5> kFields{{{"phase_rad", &RotorCalibration::phase_rad},
                                        {"tilt_rad", &RotorCalibration::tilt_rad},
                                        {"curve_rad", &RotorCalibration::curve_rad},
                                        {"gibbous_phase_rad", &RotorCalibration::gibbous_phase_rad},
                                        {"gibbous_magnitude_rad", &RotorCalibration::gibbous_magnitude_rad}}};

std::string exact(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  std::string out(text.data(), result.ptr);
  return out.find_first_of(".e") == std::string::npos ? out + ".0" : out;
}

std::string text_of(const StationCalibration& station) {
  std::array<char, 32> id{};
  std::snprintf(id.data(), id.size(), "\n[[station]]\nid = \"%08X\"\n", station.id);
  std::string out = id.data();
  for (const Field& field : kFields) {
    out += std::string(field.key) + " = [" + exact(station.rotor[0].*field.member) + ", " +
           exact(station.rotor[1].*field.member) + "]\n";
  }
  return out;
}

StationCalibration read_station(const TomlTable& table) {
  StationCalibration station;
  const std::string id = table.text("id");
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), station.id, 16);
  if (error != std::errc{} || end != id.data() + id.size()) table.fail("id", "must be eight hexadecimal digits");
  for (const Field& field : kFields) {
    const auto values = table.vector<kAxes>(field.key);
    for (std::size_t axis = 0; axis < values.size(); ++axis) station.rotor[axis].*field.member = values[axis];
  }
  return station;
}

bool write_all(int fd, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(fd, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return ::fsync(fd) == 0;
}

}  // namespace

CalibrationMemory::CalibrationMemory(const std::filesystem::path& directory)
    : file_(directory.empty() ? directory : directory / "stations.toml") {}

void CalibrationMemory::load() {
  stations_.clear();
  std::error_code error;
  if (file_.empty() || !std::filesystem::exists(file_, error)) return;
  const TomlTable root = TomlTable::parse_file(file_);
  std::vector<StationCalibration> stations;
  for (const TomlTable& table : root.tables("station")) stations.push_back(read_station(table));
  root.reject_unknown();
  stations_ = std::move(stations);
}

std::optional<std::string> CalibrationMemory::keep(const StationCalibration& calibration) {
  const auto same = std::find_if(stations_.begin(), stations_.end(),
                                 [&](const StationCalibration& station) { return station.id == calibration.id; });
  if (same == stations_.end()) {
    stations_.push_back(calibration);
  } else if (*same == calibration && written_) {
    return std::nullopt;
  } else {
    *same = calibration;
  }
  if (file_.empty()) return std::nullopt;
  const std::optional<std::string> trouble = write();
  written_ = !trouble;
  return trouble;
}

std::optional<std::string> CalibrationMemory::write() const {
  std::string text = kHeading;
  for (const StationCalibration& station : stations_) text += text_of(station);
  std::error_code error;
  std::filesystem::create_directories(file_.parent_path(), error);
  const std::filesystem::path aside = file_.string() + ".new";
  UniqueFd fd(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd.valid() || !write_all(fd.get(), text) || ::rename(aside.c_str(), file_.c_str()) != 0) {
    return file_.string() + ": cannot be written: " + std::strerror(errno);
  }
  return std::nullopt;
}

}  // namespace pharos::host
