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
  return true;
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
  while (stations_.size() > kMostStations) drop_oldest();
}

void CalibrationMemory::drop_oldest() {
  stations_.erase(stations_.begin());
  ++counters_.dropped;
}

void CalibrationMemory::keep(const StationCalibration& calibration) {
  if (!stations_.empty() && stations_.back() == calibration) return;
  std::erase_if(stations_, [&](const StationCalibration& station) { return station.id == calibration.id; });
  if (stations_.size() == kMostStations) drop_oldest();
  stations_.push_back(calibration);
  unsaved_ = !file_.empty();
}

void CalibrationMemory::save(std::int64_t monotonic_ns) {
  if (!unsaved_ || (!trouble_.empty() && monotonic_ns < retry_at_ns_)) return;
  write();
  retry_at_ns_ = monotonic_ns + kRetryNs;
}

void CalibrationMemory::save_at_last() {
  if (unsaved_) write();
}

void CalibrationMemory::write() {
  std::string text = kHeading;
  for (const StationCalibration& station : stations_) text += text_of(station);
  std::error_code ignored;  // if the folder cannot be made, opening says why
  std::filesystem::create_directories(file_.parent_path(), ignored);
  const std::filesystem::path aside = file_.string() + ".new";
  UniqueFd fd(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  unsaved_ = !fd.valid() || !write_all(fd.get(), text) || ::rename(aside.c_str(), file_.c_str()) != 0;
  trouble_ = unsaved_ ? file_.string() + ": cannot be written: " + std::strerror(errno) +
                            "; calibrations are not kept across a restart"
                      : "";
  if (!unsaved_) return;
  ++counters_.write_failures;
  if (fd.valid()) (void)::unlink(aside.c_str());
}

}  // namespace pharos::host
